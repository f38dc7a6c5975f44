#include "lbm/boundary/wall_reflection.h"

#include <algorithm>

#include "lbm/boundary/row_reflection.h"
#include "lbm/boundary/slip_wall.h"
#include "lbm/boundary/surface_cells_at_walls.h"
#include "lbm/boundary/wall_balance.h"
#include "lbm/boundary/wall_traction.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

namespace {

/// Velocity of the wall at a cell, as the reflection sees it; `rho`: that of the cell, 1 where nothing moves.
template <class Real>
std::array<Real, 3> reflection_velocity(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                                        const WallPhysics& physics, Real& rho) {
  rho = 1;
  std::array<Real, 3> v{};
  if (stands_still(wall)) return v;
  const auto m = outgoing_moments(grid, place, parity);
  rho += m.drho;
  if (wall.slip == WallSlip::wall_model) return wall_model_velocity(grid, place, wall, parity, physics, m);
  if (wall.slip == WallSlip::free_slip) return free_slip_velocity(grid, place, wall, parity, m);
  for (std::size_t k = 0; k < 3; ++k) v[k] = static_cast<Real>(wall.wall_velocity[k]);
  return v;
}

/// c_i . v
template <class Real>
Real along(int i, const std::array<Real, 3>& v) {
  const auto* c = D3Q19::c[i];
  return static_cast<Real>(c[0]) * v[0] + static_cast<Real>(c[1]) * v[1] + static_cast<Real>(c[2]) * v[2];
}

/// Weighted mean of c_i . v over the links, zero but for rounding on a wall along the lattice: subtracted there, so
/// that no mass has to be booked.
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

/// One link of an interpolated wall; returns the mass that it adds to the cell.
template <class Real>
double interpolate(FluidGrid<Real>& grid, CellPlace place, int i, const WallHit& hit, Parity parity,
                   const WallPhysics& physics) {
  const bool forward = i % 2 == 1;
  const auto pair = grid.access(place, forward ? i : i - 1, parity);
  const Real out = forward ? *pair.outgoing_a : *pair.outgoing_b,
             out_opposite = forward ? *pair.outgoing_b : *pair.outgoing_a;
  const Real arrived = forward ? *pair.incoming_a : *pair.incoming_b;
  Real& back = forward ? *pair.incoming_b : *pair.incoming_a;
  const auto w = static_cast<Real>(D3Q19::w(i)), push = 6 * w * static_cast<Real>(hit.push);
  Real q = static_cast<Real>(hit.share);
  if (q < Real(0.5) && !is_wet(grid.type(grid.neighbour(place, D3Q19::opposite(i))))) q = Real(0.5);
  const auto* c = D3Q19::c[i];
  const auto& a = physics.acceleration;
  const Real weight = 3 * w * static_cast<Real>(c[0] * a[0] + c[1] * a[1] + c[2] * a[2]);
  if (q < Real(0.5))
    back = 2 * q * out + (1 - 2 * q) * (arrived + weight) - push;
  else
    back = (out + (2 * q - 1) * (out_opposite + weight) - push) / (2 * q);
  return static_cast<double>(back) - static_cast<double>(out);
}

/// Counts what the last reflection at a wall cell added to it in the sweep, and notes what this one will. Whether it is
/// mass of the ledger is decided by what the cell is in the sweep, before it may be converted: liquid.
template <class Real>
void book_gain(Block<Real>& block, const WallCell& wall, double gained) {
  const auto entry = static_cast<std::size_t>(&wall - block.walls.cells.data());
  const bool liquid = block.type[wall.cell] == CellType::liquid;
  block.walls.gained += block.walls.gains[entry];
  block.walls.takers += liquid;
  block.walls.gains[entry] = liquid ? gained : 0;
}

/// All links of a cell at an interpolated wall.
template <class Real>
void interpolate_links(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                       const WallPhysics& physics) {
  Block<Real>& block = grid.block(place.block);
  double gained = 0;
  for (std::size_t k = wall.first_link; k < std::size_t{wall.first_link} + wall.links; ++k)
    gained += interpolate(grid, place, block.walls.directions[k], block.walls.hits[k], parity, physics);
  book_gain(block, wall, gained);
}

/// Half-way, off a wall that moves with v, and faster down its way by the stretch of the liquid; returns the mass that
/// the links add to the cell.
template <class Real>
double bounce_off(FluidGrid<Real>& grid, CellPlace place, const std::uint8_t* links, const WallCell& wall,
                  Parity parity, Real rho, const std::array<Real, 3>& v, const Stretch& stretch) {
  const Real mean_push = wall.even ? mean_wall_push(links, wall.links, v) : Real(0);
  double gained = 0;
  for (int k = 0; k < wall.links; ++k) {
    const int i = links[k], a = i % 2 == 1 ? i : i - 1;
    const auto pair = grid.access(place, a, parity);
    const Real half_way = along(i, v) - mean_push + static_cast<Real>(stretch.half_way(i));
    const Real push = static_cast<Real>(6 * D3Q19::w(i)) * rho * half_way;
    if (i == a)
      *pair.incoming_b = *pair.outgoing_a - push;
    else
      *pair.incoming_a = *pair.outgoing_b - push;
    gained -= static_cast<double>(push);
  }
  return gained;
}

/// The same off a wall that moves, or seems to: free slip and wall model.
template <class Real>
void bounce_off(FluidGrid<Real>& grid, CellPlace place, const std::uint8_t* links, const WallCell& wall, Parity parity,
                const WallPhysics& physics) {
  Real rho;
  const auto v = reflection_velocity(grid, place, wall, parity, physics, rho);
  Stretch stretch;
  if (slips_along_steps(wall)) {
    const auto m = outgoing_moments(grid, place, parity);
    stretch = stretch_along(grid, place, parity, m, slip_half_a_step_on(grid, place, wall, parity, m));
  }
  const double gained = bounce_off(grid, place, links, wall, parity, rho, v, stretch);
  if (!wall.even) book_gain(grid.block(place.block), wall, gained);
}

/// Interface cells at no-slip walls (surface_cells_at_walls.h). Whatever the wall does they keep their mass.
template <class Real>
void brake_surface_cells(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const WallPhysics& physics) {
  const Block<Real>& block = grid.block(b);
  for (const WallCell& wall : block.walls.cells) {
    if (wall.slip != WallSlip::no_slip || block.type[wall.cell] != CellType::interface) continue;
    const CellPlace place{b, wall.cell};
    const auto m = outgoing_moments(grid, place, parity);
    bounce_off(grid, place, block.walls.directions.data() + wall.first_link, wall, parity, Real(1) + m.drho,
               surface_cell_wall_velocity(grid, place, wall, parity, physics, m), Stretch{});
  }
}

/// The part of a velocity whose momentum a wall gets: of what goes along a mirror that across it.
int given_to_wall(const LinksAlongMirrors& along_mirrors, const WallCell& wall, int i) {
  return along_mirrors.contain(wall.cell, i) ? mirror_link(i, normal_axis(wall)).into : i;
}

/// By axis velocity: the wall that it leads to from a cell, -1 for none. The cell's entries follow each other.
std::array<int, 7> walls_beside(const WallLinks& walls, std::size_t first) {
  std::array<int, 7> beside;
  beside.fill(-1);
  for (std::size_t e = first; e < walls.cells.size() && walls.cells[e].cell == walls.cells[first].cell; ++e)
    for (int k = 0; k < walls.cells[e].links; ++k)
      if (const std::size_t i = walls.directions[walls.cells[e].first_link + static_cast<std::size_t>(k)]; i < 7)
        beside[i] = walls.cells[e].wall;
  return beside;
}

/// What went into the wall over the links of a cell and what came back. Cells at the surface move as if they were full:
/// of theirs the wall gets the part that is. A link into the edge of two walls presses on both, on each along the axis
/// that leads to it from the cell.
template <class Real>
void add_load(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, const std::uint8_t* links,
              const std::array<int, 7>& beside, const LinksAlongMirrors& along_mirrors, Parity parity,
              BlockWallLoads& loads) {
  const Block<Real>& block = grid.block(place.block);
  const double full =
      block.type[wall.cell] == CellType::interface ? std::clamp(
                                                         static_cast<double>(block.surface->fill_level[wall.cell]), 0.0,
                                                         1.0)
                                                   : 1.0;
  const auto p = cell_position(place.cell);
  const Vec3i cell = grid.lowest_cell(place.block) + Vec3i(p[0], p[1], p[2]);
  const Vec3 centre = cell.cast<double>() + Vec3::Constant(0.5);
  for (int k = 0; k < wall.links; ++k) {
    const int i = links[k], a = i % 2 == 1 ? i : i - 1;
    const auto pair = grid.access(place, a, parity);
    const double sent = static_cast<double>(i == a ? *pair.outgoing_a : *pair.outgoing_b);
    const double back = static_cast<double>(i == a ? *pair.incoming_b : *pair.incoming_a);
    const auto* c = D3Q19::c[i];
    const auto* given = D3Q19::c[given_to_wall(along_mirrors, wall, i)];
    const Vec3 at = centre + 0.5 * Vec3(c[0], c[1], c[2]),
               impulse = full * (sent + back) * Vec3(given[0], given[1], given[2]);
    bool into_edge = true;
    std::array<int, 3> of_axis{-1, -1, -1};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (given[axis] == 0) continue;
      of_axis[axis] = beside[2 * axis + (given[axis] > 0 ? 1 : 2)];
      into_edge = into_edge && of_axis[axis] >= 0;
    }
    if (!into_edge) {
      loads.add(wall.wall, at, impulse);
      continue;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (given[axis] != 0)
        loads.add(of_axis[axis], at,
                  impulse[static_cast<Eigen::Index>(axis)] * Vec3::Unit(static_cast<Eigen::Index>(axis)));
  }
}

template <class Real>
void add_loads(FluidGrid<Real>& grid, BlockIndex b, Parity parity, BlockWallLoads& loads) {
  const Block<Real>& block = grid.block(b);
  const WallLinks& walls = block.walls;
  const LinksAlongMirrors along_mirrors(walls);
  std::array<int, 7> beside{};
  for (std::size_t e = 0; e < walls.cells.size(); ++e) {
    const WallCell& wall = walls.cells[e];
    if (!is_wet(block.type[wall.cell])) continue;
    if (e == 0 || walls.cells[e - 1].cell != wall.cell) beside = walls_beside(walls, e);
    add_load(grid, {b, wall.cell}, wall, walls.directions.data() + wall.first_link, beside, along_mirrors, parity,
             loads);
  }
}

}  // namespace

template <class Real>
void reflect_at_walls(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const WallPhysics& physics,
                      BlockWallLoads* loads) {
  Block<Real>& block = grid.block(b);
  block.walls.gained = 0, block.walls.takers = 0;
  block.walls.gains.resize(block.walls.cells.size(), 0);
  reflect_rows(grid, b, parity, physics.equilibrium_order);
  int getters = 0;  // entries that the last reflection gave something
  for (const std::uint16_t entry : block.walls.others) {
    getters += block.walls.gains[entry] != 0;
    const WallCell& wall = block.walls.cells[entry];
    const CellPlace place{b, wall.cell};
    const std::uint8_t* const links = block.walls.directions.data() + wall.first_link;
    if (!is_wet(block.type[wall.cell]))
      block.walls.gains[entry] = 0;
    else if (wall.slip == WallSlip::no_slip && !block.walls.hits.empty())
      interpolate_links(grid, place, wall, parity, physics);
    else
      bounce_off(grid, place, links, wall, parity, physics);
  }
  block.walls.takers = std::max(block.walls.takers, getters);  // who is left does not pay for who was converted
  if (block.surface && physics.newtonian && physics.viscosity < kBounceBackViscosity)
    brake_surface_cells(grid, b, parity, physics);
  if (loads) add_loads(grid, b, parity, *loads);
}

template void reflect_at_walls<float>(FluidGrid<float>&, BlockIndex, Parity, const WallPhysics&, BlockWallLoads*);
template void reflect_at_walls<double>(FluidGrid<double>&, BlockIndex, Parity, const WallPhysics&, BlockWallLoads*);

}  // namespace lahar::lbm
