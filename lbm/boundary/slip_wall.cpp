#include "lbm/boundary/slip_wall.h"

#include <array>
#include <cmath>

#include "lbm/cell_moments.h"
#include "lbm/equilibrium.h"

namespace lahar::lbm {

namespace {

/// The velocity with given components.
int velocity_index(const int (&c)[3]) {
  for (int i = 0; i < D3Q19::q; ++i)
    if (D3Q19::c[i][0] == c[0] && D3Q19::c[i][1] == c[1] && D3Q19::c[i][2] == c[2]) return i;
  return 0;
}

/// Axis of a wall's normal, -1 if it does not lie along one.
int normal_axis(const WallCell& wall) {
  for (int a = 0; a < 3; ++a)
    if (std::abs(wall.normal[static_cast<std::size_t>(a)]) > 1 - 1e-6F) return a;
  return -1;
}

/// A velocity into a wall, taken apart.
struct MirrorLink {
  int into;      ///< its part across the wall
  int along;     ///< its part along the wall, 0 if it has none
  int mirrored;  ///< into less along: the velocity that its way back has in the mirror
};

MirrorLink take_apart(int i, int axis) {
  int into[3] = {0, 0, 0}, along[3] = {0, 0, 0}, mirrored[3];
  for (int a = 0; a < 3; ++a) (a == axis ? into : along)[a] = D3Q19::c[i][a];
  for (int a = 0; a < 3; ++a) mirrored[a] = into[a] - along[a];
  return {velocity_index(into), velocity_index(along), velocity_index(mirrored)};
}

using MirrorTable = std::array<std::array<MirrorLink, D3Q19::q>, 3>;

/// Every velocity, for walls across every axis.
MirrorTable all_mirror_links() {
  MirrorTable table{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < D3Q19::q; ++i) table[axis][i] = take_apart(static_cast<int>(i), static_cast<int>(axis));
  return table;
}

const MirrorTable kMirrorLinks = all_mirror_links();

const MirrorLink& mirror_link(int i, int axis) {
  return kMirrorLinks[static_cast<std::size_t>(axis)][static_cast<std::size_t>(i)];
}

/// The populations of one velocity at a cell.
template <class Real>
struct Way {
  Real* sent;  ///< f_i that went out
  Real* back;  ///< f_opposite(i) that comes in
};

template <class Real>
Way<Real> way_of(FluidGrid<Real>& grid, CellPlace place, int i, Parity parity) {
  const bool forward = i % 2 == 1;
  const auto pair = grid.access(place, forward ? i : i - 1, parity);
  if (forward) return {pair.outgoing_a, pair.incoming_b};
  return {pair.outgoing_b, pair.incoming_a};
}

bool has_link(const std::uint8_t* links, int count, int i) {
  for (int k = 0; k < count; ++k)
    if (links[k] == i) return true;
  return false;
}

/// Share of a link's flux that is mass of an interface cell.
template <class Real>
Real exchange_share(const FluidGrid<Real>& grid, CellPlace to, Real fill) {
  const CellType type = grid.type(to);
  if (type == CellType::liquid) return 1;
  if (type != CellType::interface) return 0;
  return Real(0.5) * (fill + grid.block(to.block).surface->fill_level[to.cell]);
}

}  // namespace

bool is_mirror(const WallCell& wall) { return wall.slip == WallSlip::free_slip && normal_axis(wall) >= 0; }

template <class Real>
void mirror(FluidGrid<Real>& grid, CellPlace place, WallCell& wall, const std::uint8_t* links, Parity parity) {
  const int axis = normal_axis(wall);
  wall.mirrored = 0;
  for (int k = 0; k < wall.links; ++k) {
    const MirrorLink& link = mirror_link(links[k], axis);
    const auto way = way_of(grid, place, links[k], parity);
    *way.back = *way.sent;
    if (link.into == 0 || link.along == 0 || !has_link(links, wall.links, link.into)) continue;
    const CellPlace beside = grid.neighbour(place, link.along);
    const CellType type = grid.type(beside);
    if (type == CellType::wall) continue;
    if (is_wet(type)) {
      *way.back = *way_of(grid, beside, link.mirrored, parity).sent;
      wall.mirrored |= std::uint32_t{1} << k;
    } else {
      const auto m = outgoing_moments(grid, place, parity);
      *way.back = equilibrium_pair_sum(links[k], Real(0), m.u[0], m.u[1], m.u[2]) - *way.sent;
    }
  }
}

template <class Real>
void exchange_over_mirrors(FluidGrid<Real>& grid, BlockIndex b, Parity parity) {
  Block<Real>& block = grid.block(b);
  if (!block.surface) return;
  for (const WallCell& wall : block.walls.cells) {
    if (wall.mirrored == 0 || block.type[wall.cell] != CellType::interface) continue;
    const CellPlace place{b, wall.cell};
    const int axis = normal_axis(wall);
    const Real fill = block.surface->fill_level[wall.cell];
    Real gain = 0;
    for (int k = 0; k < wall.links; ++k) {
      if (!(wall.mirrored >> k & 1)) continue;
      const int i = block.walls.directions[static_cast<std::size_t>(wall.first_link + k)];
      const auto way = way_of(grid, place, i, parity);
      gain += exchange_share(grid, grid.neighbour(place, mirror_link(i, axis).along), fill) * (*way.back - *way.sent);
    }
    block.surface->mass[wall.cell] += gain;
  }
}

template void mirror<float>(FluidGrid<float>&, CellPlace, WallCell&, const std::uint8_t*, Parity);
template void mirror<double>(FluidGrid<double>&, CellPlace, WallCell&, const std::uint8_t*, Parity);
template void exchange_over_mirrors<float>(FluidGrid<float>&, BlockIndex, Parity);
template void exchange_over_mirrors<double>(FluidGrid<double>&, BlockIndex, Parity);

}  // namespace lahar::lbm
