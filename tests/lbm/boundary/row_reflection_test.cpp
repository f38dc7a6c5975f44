// Every link off walls at rest and mirrors, cell by cell, after steps that reflected them by rows.
#include "lbm/boundary/row_reflection.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lbm/boundary/slip_wall.h"
#include "lbm/collision/equilibrium.h"
#include "lbm/step/cell_moments.h"
#include "lbm/step/fluid.h"

namespace lahar::lbm {
namespace {

struct Count {
  int straight = 0, mirrored = 0, at_gas = 0;
};

/// What comes back over one link of a wet cell must be what the rule says (slip_wall.h).
template <class Real>
void expect_reflected(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, const std::uint8_t* links, int i,
                      Parity parity, Count& count) {
  const auto way = link_populations(grid, place, i, parity);
  const MirrorLink link = is_mirror(wall) ? mirror_link(i, normal_axis(wall)) : MirrorLink{};
  const bool aside =
      link.into != 0 && link.along != 0 && std::find(links, links + wall.links, link.into) != links + wall.links;
  const CellPlace beside = aside ? grid.neighbour(place, link.along) : place;
  if (!aside || grid.type(beside) == CellType::wall) {
    EXPECT_EQ(*way.back, *way.sent) << i;
    ++count.straight;
  } else if (is_wet(grid.type(beside))) {
    EXPECT_EQ(*way.back, *link_populations(grid, beside, link.mirrored, parity).sent) << i;
    ++count.mirrored;
  } else {
    const auto m = outgoing_moments(grid, place, parity);
    const HigherMoments<Real> higher(CentralMoments::equilibrium_order, m.u[0], m.u[1], m.u[2]);
    const Real sum = equilibrium_pair_sum(i, Real(0), m.u[0], m.u[1], m.u[2]) + higher.pair_sum(i);
    EXPECT_NEAR(*way.back, sum - *way.sent, 1e-15) << i;
    ++count.at_gas;
  }
}

/// A dam breaks over a slipping bed, around a slipping post, under a roof that does not slip; walls across all axes.
TEST(RowReflection, GivesEveryLinkWhatItsRuleSays) {
  FluidOptions o;
  o.domain.cell_size = 0.02;
  o.domain.upper = Vec3(1.0, 0.4, 0.6);
  o.domain.faces[5] = FaceKind::open;
  o.gravity = Vec3(0, 0, -9.81);
  o.time_step = 0.1 * o.domain.cell_size / 3;
  o.domain.walls.add({"bed", SolidBox{Vec3(-1, -1, -1), Vec3(3, 2, 0.05)}, WallSlip::free_slip});
  o.domain.walls.add({"post", SolidBox{Vec3(0.5, 0.1, -1), Vec3(0.6, 0.3, 0.4)}, WallSlip::free_slip});
  o.domain.walls.add({"roof", SolidBox{Vec3(0.7, -1, 0.2), Vec3(3, 2, 0.3)}, WallSlip::no_slip});
  Fluid<double> fluid(o);
  fluid.fill({{Vec3(0, 0, 0.05), Vec3(0.4, 0.4, 0.5)}});
  Count count;
  for (int look = 0; look < 4; ++look) {
    for (int s = 0; s < 75; ++s) fluid.step();
    auto& grid = fluid.grid();
    for (const BlockIndex b : grid.owned()) {
      const Block<double>& block = grid.block(b);
      for (const WallCell& wall : block.walls.cells) {
        if (!is_wet(block.type[wall.cell])) continue;
        // Interface cells at no-slip walls have a rule of their own (surface_cells_at_walls.h).
        if (wall.slip == WallSlip::no_slip && block.type[wall.cell] == CellType::interface) continue;
        const std::uint8_t* const links = block.walls.directions.data() + wall.first_link;
        for (int k = 0; k < wall.links; ++k)
          expect_reflected(grid, {b, wall.cell}, wall, links, links[k], fluid.parity(), count);
      }
    }
  }
  EXPECT_GT(count.straight, 1000);
  EXPECT_GT(count.mirrored, 1000);
  EXPECT_GT(count.at_gas, 100);
}

}  // namespace
}  // namespace lahar::lbm
