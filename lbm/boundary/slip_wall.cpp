#include "lbm/boundary/slip_wall.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lbm/boundary/row_reflection.h"

namespace lahar::lbm {

namespace {

/// The velocity with given components.
int velocity_index(const int (&c)[3]) {
  for (int i = 0; i < D3Q19::q; ++i)
    if (D3Q19::c[i][0] == c[0] && D3Q19::c[i][1] == c[1] && D3Q19::c[i][2] == c[2]) return i;
  return 0;
}

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

}  // namespace

bool is_along_axis(float component) { return std::abs(component) > 1 - 1e-6F; }

int normal_axis(const WallCell& wall) {
  for (int a = 0; a < 3; ++a)
    if (is_along_axis(wall.normal[static_cast<std::size_t>(a)])) return a;
  return -1;
}

bool is_mirror(const WallCell& wall) { return wall.slip != WallSlip::no_slip && normal_axis(wall) >= 0; }

const MirrorLink& mirror_link(int i, int axis) {
  return kMirrorLinks[static_cast<std::size_t>(axis)][static_cast<std::size_t>(i)];
}

template <class Real>
void exchange_over_mirrors(FluidGrid<Real>& grid, BlockIndex b, Parity parity) {
  Block<Real>& block = grid.block(b);
  const auto& rows = block.walls.rows;
  if (!block.surface || std::none_of(rows.begin(), rows.end(), [](const RowLink& r) { return r.mirrored != 0; }))
    return;
  const MirroredLinks mirrored(block.walls);
  const auto& directions = block.walls.directions;
  for (const WallCell& wall : block.walls.cells) {
    if (block.type[wall.cell] != CellType::interface) continue;
    const std::uint32_t links = mirrored.of(wall, directions.data());
    if (links == 0) continue;
    const CellPlace place{b, wall.cell};
    const int axis = normal_axis(wall);
    Real gain = 0;
    for (int k = 0; k < wall.links; ++k) {
      if (!(links >> k & 1)) continue;
      const int i = directions[static_cast<std::size_t>(wall.first_link + k)];
      const auto link = link_populations(grid, place, i, parity);
      if (grid.type(grid.neighbour(place, mirror_link(i, axis).along)) == CellType::liquid)
        gain += *link.back - *link.sent;
    }
    block.surface->mass[wall.cell] += gain;
  }
}

template void exchange_over_mirrors<float>(FluidGrid<float>&, BlockIndex, Parity);
template void exchange_over_mirrors<double>(FluidGrid<double>&, BlockIndex, Parity);

}  // namespace lahar::lbm
