#include "lbm/boundary/wall_braking.h"

#include <algorithm>

#include "lbm/boundary/slip_wall.h"
#include "lbm/boundary/wall_traction.h"

namespace lahar::lbm {

namespace {

Vec3 direction(int i) { return Vec3(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]); }

/// Density and velocity of what is on its way to a cell.
template <class Real>
CellMoments<Real> incoming_moments(FluidGrid<Real>& grid, CellPlace place, Parity parity) {
  Real drho = grid.block(place.block).f(0)[place.cell];
  Real j[3] = {0, 0, 0};
  for (int a = 1; a < D3Q19::q; a += 2) {
    const auto pair = grid.access(place, a, parity);
    const Real fa = *pair.incoming_a, fb = *pair.incoming_b;
    drho += fa + fb;
    for (int k = 0; k < 3; ++k) j[k] += static_cast<Real>(D3Q19::c[a][k]) * (fa - fb);
  }
  const Real inverse = Real(1) / (Real(1) + drho);
  return {drho, {j[0] * inverse, j[1] * inverse, j[2] * inverse}};
}

/// Takes momentum along the wall off a cell. False if no link leads straight into the wall: the cell is beside it.
template <class Real>
bool take_off(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity, const Vec3& momentum) {
  const std::uint8_t* const first = grid.block(place.block).walls.directions.data() + wall.first_link;
  const std::uint8_t* const end = first + wall.links;
  const auto has = [&](int i) { return std::find(first, end, static_cast<std::uint8_t>(i)) != end; };
  const int axis = normal_axis(wall);
  const auto* const straight = std::find_if(first, end, [&](int i) { return mirror_link(i, axis).along == 0; });
  if (straight == end || mirror_link(*straight, axis).into == 0) return false;
  double sum = 0;
  for (const std::uint8_t* link = first; link != end; ++link) {
    const MirrorLink& parts = mirror_link(*link, axis);
    if (parts.into != *straight || parts.along == 0) continue;
    const bool other_way = has(parts.mirrored);
    const double more = (other_way ? 0.5 : 1.0) * momentum.dot(direction(parts.along));
    *link_populations(grid, place, *link, parity).back += static_cast<Real>(more);
    sum += more;
  }
  *link_populations(grid, place, *straight, parity).back -= static_cast<Real>(sum);
  return true;
}

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

bool some_wall_brakes(const Domain& domain) {
  const auto& walls = domain.walls().all();
  return std::any_of(walls.begin(), walls.end(), [](const Wall& w) { return w.slip == WallSlip::wall_model; });
}

template <class Real>
void brake_at_walls(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const WallPhysics& physics,
                    BlockWallLoads* loads) {
  const Block<Real>& block = grid.block(b);
  for (const WallCell& wall : block.walls.cells) {
    if (wall.slip != WallSlip::wall_model || !is_mirror(wall) || !is_wet(block.type[wall.cell])) continue;
    const CellPlace place{b, wall.cell};
    const Vec3 momentum = asked_for(grid, place, wall, parity, physics);
    if (momentum.isZero(0) || !take_off(grid, place, wall, parity, momentum) || !loads) continue;
    const auto p = cell_position(place.cell);
    const Vec3 centre = (grid.lowest_cell(b) + Vec3i(p[0], p[1], p[2])).template cast<double>() + Vec3::Constant(0.5);
    const Vec3 foot = centre - 0.5 * Vec3(wall.normal[0], wall.normal[1], wall.normal[2]);
    loads->add(wall.wall, foot, full_part(block, place.cell) * momentum);
  }
}

template void brake_at_walls<float>(FluidGrid<float>&, BlockIndex, Parity, const WallPhysics&, BlockWallLoads*);
template void brake_at_walls<double>(FluidGrid<double>&, BlockIndex, Parity, const WallPhysics&, BlockWallLoads*);

}  // namespace lahar::lbm
