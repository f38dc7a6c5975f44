#include "lbm/boundary/wall_reflection.h"

#include "lbm/cell_moments.h"

namespace lahar::lbm {

namespace {

/// Velocity of the wall at a cell, as the reflection sees it.
template <class Real>
std::array<Real, 3> reflection_velocity(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                                        Real& rho) {
  rho = 1;
  std::array<Real, 3> v{};
  if (wall.free_slip) {
    const auto m = outgoing_moments(grid, place, parity);
    rho += m.drho;
    Real normal_speed = 0;
    for (std::size_t k = 0; k < 3; ++k) normal_speed += m.u[k] * static_cast<Real>(wall.normal[k]);
    for (std::size_t k = 0; k < 3; ++k) v[k] = m.u[k] - normal_speed * static_cast<Real>(wall.normal[k]);
  } else {
    for (std::size_t k = 0; k < 3; ++k) v[k] = static_cast<Real>(wall.wall_velocity[k]);
  }
  return v;
}

/// c_i . v
template <class Real>
Real along(int i, const std::array<Real, 3>& v) {
  const auto* c = D3Q19::c[i];
  return static_cast<Real>(c[0]) * v[0] + static_cast<Real>(c[1]) * v[1] + static_cast<Real>(c[2]) * v[2];
}

/// Weighted mean of c_i . v over the links: subtracted, so that the links together leave the mass as it is. It is zero on
/// a flat wall.
template <class Real>
Real mean_wall_push(const std::uint8_t* links, int count, const std::array<Real, 3>& v) {
  Real sum = 0, weights = 0;
  for (int k = 0; k < count; ++k) {
    const Real w = static_cast<Real>(D3Q19::w(links[k]));
    sum += w * along(links[k], v);
    weights += w;
  }
  return sum / weights;
}

/// What went into the wall over the links of a cell and what came back.
template <class Real>
void add_load(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, const std::uint8_t* links, Parity parity,
              BlockWallLoads& loads) {
  const auto p = cell_position(place.cell);
  const Vec3i cell = grid.lowest_cell(place.block) + Vec3i(p[0], p[1], p[2]);
  const Vec3 centre = cell.cast<double>() + Vec3::Constant(0.5);
  for (int k = 0; k < wall.links; ++k) {
    const int i = links[k], a = i % 2 == 1 ? i : i - 1;
    const auto pair = grid.access(place, a, parity);
    const double sent = static_cast<double>(i == a ? *pair.outgoing_a : *pair.outgoing_b);
    const double back = static_cast<double>(i == a ? *pair.incoming_b : *pair.incoming_a);
    const Vec3 c(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
    loads.add(wall.wall, centre + 0.5 * c, (sent + back) * c);
  }
}

}  // namespace

template <class Real>
void reflect_at_walls(FluidGrid<Real>& grid, BlockIndex b, Parity parity, BlockWallLoads* loads) {
  Block<Real>& block = grid.block(b);
  for (const WallCell& wall : block.walls.cells) {
    const CellPlace place{b, wall.cell};
    if (!is_wet(block.type[wall.cell])) continue;
    Real rho;
    const auto v = reflection_velocity(grid, place, wall, parity, rho);
    const auto* links = block.walls.directions.data() + wall.first_link;
    const Real mean_push = mean_wall_push(links, wall.links, v);
    for (int k = 0; k < wall.links; ++k) {
      const int i = links[k], a = i % 2 == 1 ? i : i - 1;
      const auto pair = grid.access(place, a, parity);
      const Real push = static_cast<Real>(6 * D3Q19::w(i)) * rho * (along(i, v) - mean_push);
      if (i == a) *pair.incoming_b = *pair.outgoing_a - push;
      else *pair.incoming_a = *pair.outgoing_b - push;
    }
    if (loads) add_load(grid, place, wall, links, parity, *loads);
  }
}

template void reflect_at_walls<float>(FluidGrid<float>&, BlockIndex, Parity, BlockWallLoads*);
template void reflect_at_walls<double>(FluidGrid<double>&, BlockIndex, Parity, BlockWallLoads*);

}  // namespace lahar::lbm
