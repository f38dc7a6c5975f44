#include "lbm/boundary/wall_braking.h"

#include <algorithm>
#include <span>

#include "lbm/boundary/slip_wall.h"
#include "lbm/boundary/wall_traction.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

namespace {

Vec3 direction(int i) { return Vec3(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]); }

/// A cell at a mirror, and what comes back to it over its slanted links.
template <class Real>
class MirrorCell {
 public:
  MirrorCell(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity)
      : grid_(grid),
        place_(place),
        parity_(parity),
        axis_(normal_axis(wall)),
        links_(grid.block(place.block).walls.directions.data() + wall.first_link, wall.links) {
    for (const std::uint8_t i : links_)
      if (mirror_link(i, axis_).along == 0 &&
          direction(i)[axis_] * static_cast<double>(wall.normal[static_cast<std::size_t>(axis_)]) < 0)
        straight_ = i;
  }

  /// False if the cell is only beside the wall.
  [[nodiscard]] bool stands_on_wall() const { return straight_ != 0; }

  /// Takes momentum along the wall off the cell.
  void take_off(const Vec3& momentum) {
    for (const std::uint8_t i : links_) {
      const MirrorLink& parts = mirror_link(i, axis_);
      if (parts.into == straight_ && parts.along != 0)
        change(i, (has(parts.mirrored) ? 0.5 : 1.0) * momentum.dot(direction(parts.along)));
    }
  }

 private:
  [[nodiscard]] bool has(int i) const { return std::find(links_.begin(), links_.end(), i) != links_.end(); }
  /// More comes back over a link, and less straight out of the wall.
  void change(int i, double more) {
    *link_populations(grid_, place_, i, parity_).back += static_cast<Real>(more);
    *link_populations(grid_, place_, straight_, parity_).back -= static_cast<Real>(more);
  }

  FluidGrid<Real>& grid_;
  CellPlace place_;
  Parity parity_;
  int axis_;
  std::span<const std::uint8_t> links_;
  int straight_ = 0;
};

/// Momentum that the law takes off a cell in the coming step, lu.
template <class Real>
Vec3 asked_for(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
               const WallPhysics& physics) {
  const auto m = incoming_moments(grid, place, parity);
  const Vec3 half_force = 0.5 * Vec3(physics.acceleration[0], physics.acceleration[1], physics.acceleration[2]);
  const Vec3 own = slip_of(wall, m) + along_wall(half_force, wall);
  const WallLaw law = wall_law(grid, place, wall, parity, physics, own);
  if (law.speed == 0) return Vec3::Zero();
  const double stress = law.of_cell ? law.stress / (1 + law.stress / law.speed) : law.stress;
  return (1 + static_cast<double>(m.drho)) * stress * law.way;
}

/// The part of a cell's populations that is liquid: cells at the surface move as if they were full.
template <class Real>
double full_part(const Block<Real>& block, int cell) {
  if (block.type[static_cast<std::size_t>(cell)] != CellType::interface) return 1;
  return std::clamp(static_cast<double>(block.surface->fill_level[cell]), 0.0, 1.0);
}

}  // namespace

template <class Real>
void brake_at_walls(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const WallPhysics& physics,
                    BlockWallLoads* loads) {
  const Block<Real>& block = grid.block(b);
  if (!block.walls.brakes) return;
  for (const WallCell& wall : block.walls.cells) {
    if (wall.slip != WallSlip::wall_model || !is_mirror(wall) || !is_wet(block.type[wall.cell])) continue;
    const CellPlace place{b, wall.cell};
    MirrorCell<Real> cell(grid, place, wall, parity);
    if (!cell.stands_on_wall()) continue;
    const Vec3 taken = asked_for(grid, place, wall, parity, physics);
    cell.take_off(taken);
    if (!loads) continue;
    const auto p = cell_position(place.cell);
    const Vec3 centre = (grid.lowest_cell(b) + Vec3i(p[0], p[1], p[2])).template cast<double>() + Vec3::Constant(0.5);
    const Vec3 foot = centre - 0.5 * Vec3(wall.normal[0], wall.normal[1], wall.normal[2]);
    loads->add(wall.wall, foot, full_part(block, place.cell) * taken);
  }
}

template void brake_at_walls<float>(FluidGrid<float>&, BlockIndex, Parity, const WallPhysics&, BlockWallLoads*);
template void brake_at_walls<double>(FluidGrid<double>&, BlockIndex, Parity, const WallPhysics&, BlockWallLoads*);

}  // namespace lahar::lbm
