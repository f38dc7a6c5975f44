// Every link off walls at rest and mirrors, cell by cell, after steps that reflected them by rows.
#include "lbm/boundary/row_reflection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "lbm/boundary/slip_wall.h"
#include "lbm/collision/equilibrium.h"
#include "lbm/step/cell_moments.h"
#include "lbm/step/fluid.h"
#include "tests/core/shapes.h"
#include "tests/lbm/flows.h"

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

/// Whether a link of a cell is one that a mirror leads over a bend: the wall that it leads into is in steps there.
bool is_over_bend(const WallLinks& walls, int cell, int i) {
  const auto of_cell = [&](const WallCell& wall) { return wall.cell == cell; };
  const auto has_link = [&](const WallCell& wall) {
    const auto first = walls.directions.begin() + wall.first_link;
    return of_cell(wall) && is_mirror(wall) && std::find(first, first + wall.links, i) != first + wall.links;
  };
  const auto mirror = std::find_if(walls.cells.begin(), walls.cells.end(), has_link);
  return mirror != walls.cells.end() && std::any_of(walls.cells.begin(), walls.cells.end(), [&](const WallCell& wall) {
           return of_cell(wall) && wall.wall == mirror->wall && is_in_steps(wall);
         });
}

/// Where a mirror gives a cell what another one sent, the other gets what that one sent: each population is used once.
/// Counts the links over bends.
int expect_pairs(FluidGrid<double>& grid) {
  const auto link_at = [&](CellPlace place, int i) -> const RowLink* {
    for (const RowLink& link : grid.block(place.block).walls.rows)
      if (link.row == place.cell / kBlockWidth && link.direction == i && (link.cells >> place.cell % kBlockWidth & 1))
        return &link;
    return nullptr;
  };
  int over_bends = 0;
  for (const BlockIndex b : grid.owned())
    for (const RowLink& link : grid.block(b).walls.rows) {
      if (link.along == 0) continue;
      for (int x = 0; x < kBlockWidth; ++x) {
        if (!(link.cells >> x & 1)) continue;
        const CellPlace place{b, kBlockWidth * link.row + x}, beside = grid.neighbour(place, link.along);
        EXPECT_NE(grid.type(beside), CellType::wall);
        const RowLink* const other = link_at(beside, link.source);
        EXPECT_NE(other, nullptr) << b << ' ' << place.cell << ' ' << int(link.direction);
        if (other == nullptr) continue;
        EXPECT_EQ(other->along, D3Q19::opposite(link.along));
        EXPECT_EQ(other->source, link.direction);
        over_bends += is_over_bend(grid.block(b).walls, place.cell, link.direction);
      }
    }
  return over_bends;
}

/// A bed that is level and then rises, a flume whose bed and sides are one surface with the bed nearer or farther than
/// the side in the corner's cell, and a bend before a gate that holds the water there until it opens.
TEST(RowReflection, MirrorsLeadBothWays) {
  const auto fluid_over = [](const FluidOptions& o) {
    auto fluid = std::make_unique<Fluid<double>>(o);
    fluid->fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, no_pressure);
    return fluid;
  };
  const auto sampled_bed = [](double step, const std::function<double(const Vec3&)>& distance) {
    return Wall{"bed", SampledDistance{sampled(Vec3(-4, -4, -4), Vec3(36, 20, 28), step, distance)},
                WallSlip::free_slip};
  };
  const auto bent_at = [&](double x) {
    FluidOptions o = lattice_options({32, 16, 24}, 0.01);
    o.domain.faces = {FaceKind::closed,   FaceKind::closed, FaceKind::periodic,
                      FaceKind::periodic, FaceKind::closed, FaceKind::closed};
    o.domain.slip = WallSlip::free_slip;
    o.domain.walls.add(sampled_bed(0.5, [x](const Vec3& p) {
      return std::min(p.z() - 2.3, (p - Vec3(x, 0, 2.3)).dot(Vec3(-0.1, 0, 1).normalized()));
    }));
    return o;
  };
  EXPECT_GT(expect_pairs(fluid_over(bent_at(14))->grid()), 0);

  for (const double bed : {0.75, 1.5, 1.9})
    for (const double step : {0.25, 0.5}) {
      FluidOptions flume = lattice_options({32, 16, 24}, 0.01);
      flume.domain.faces.fill(FaceKind::closed);
      flume.domain.walls.add(sampled_bed(step, [&](const Vec3& p) { return std::min(p.z() - bed, p.x() - 0.25); }));
      expect_pairs(fluid_over(flume)->grid());
    }

  for (const double bend : {14.0, 14.5, 15.0, 15.5, 16.0}) {
    FluidOptions gated = bent_at(bend);  // blocks end at x = 15
    Wall gate{"gate", SolidBox{Vec3(16, -1, 0), Vec3(18, 20, 30)}, WallSlip::no_slip};
    gate.opens_at = 3;
    gated.domain.walls.add(gate);
    const auto fluid = fluid_over(gated);
    expect_pairs(fluid->grid());
    EXPECT_TRUE(fluid->open_walls_by(3));
    EXPECT_GT(expect_pairs(fluid->grid()), 0) << bend;
  }
}

}  // namespace
}  // namespace lahar::lbm
