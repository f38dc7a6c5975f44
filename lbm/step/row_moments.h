#pragma once
// Density and velocity of the cells of a row, and of a whole block, between two steps: cell_moments.h eight at a time.
#include <bit>

#include "lbm/grid/fluid_grid.h"
#include "lbm/step/gather.h"

namespace lahar::lbm {

/// A field of the blocks around one, seen at an offset of up to one cell from the row that starts with cell `first`:
/// the numbers at n + (CX, CY, CZ). `field(block)` is a block's own, also of a missing one (null).
template <int CX, int CY, int CZ, class Real, class Field>
[[gnu::always_inline]] inline Row<Real> row_at(const std::array<Block<Real>*, 27>& around, int first,
                                               const Field& field) {
  const auto p = cell_position(first);
  const int y = p[1] + CY, z = p[2] + CZ, there = cell_index(0, y & 7, z & 7);
  const auto slot = static_cast<std::size_t>(neighbour_slot(0, y >> 3, z >> 3));
  const auto numbers = [&](const Block<Real>* block) __attribute__((always_inline)) {
    return load<Row<Real>>(field(block) + there);
  };
  const Row<Real> near = numbers(around[slot]);
  if constexpr (CX == 1) return shuffle<1, 2, 3, 4, 5, 6, 7, 8>(near, numbers(around[slot + 9]));
  if constexpr (CX == -1) return shuffle<7, 8, 9, 10, 11, 12, 13, 14>(numbers(around[slot - 9]), near);
  return near;
}

/// One velocity seen at an offset. A missing block reads as rest at density 1.
template <int CX, int CY, int CZ, class Real>
[[gnu::always_inline]] inline Row<Real> row_ahead(const std::array<Block<Real>*, 27>& around, int velocity, int first) {
  return row_at<CX, CY, CZ>(
      around, first, [velocity](const Block<Real>* block) __attribute__((always_inline)) {
        return block ? block->f(velocity) : kRest<Real>;
      });
}

/// rho - 1 after the last collision in the row that starts with cell `first` of a block with these neighbours.
template <class Real>
Row<Real> outgoing_density(const std::array<Block<Real>*, 27>& around, int first, Parity parity) {
  Row<Real> drho = load<Row<Real>>(around[13]->f(0) + first);
  for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
    drho += row_ahead<CX, CY, CZ>(around, parity.home(D3Q19::forward(P)), first) +
            load<Row<Real>>(around[13]->f(parity.away(D3Q19::forward(P))) + first);
  });
  return drho;
}

/// outgoing_moments of eight cells, to the bit.
template <class Real>
struct RowMoments {
  Row<Real> drho, u[3];
};

/// Of the row that starts with cell `first` of a block with these neighbours.
template <class Real>
RowMoments<Real> outgoing_moments_of_row(const std::array<Block<Real>*, 27>& around, int first, Parity parity) {
  using V = Row<Real>;
  V drho = load<V>(around[13]->f(0) + first), j[3] = {V(0), V(0), V(0)};
  for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
    const V fa = row_ahead<CX, CY, CZ>(around, parity.home(D3Q19::forward(P)), first);
    const V fb = load<V>(around[13]->f(parity.away(D3Q19::forward(P))) + first);
    constexpr int c[3] = {CX, CY, CZ};
    drho += fa + fb;
    for (int k = 0; k < 3; ++k)
      if (c[k] != 0) j[k] += static_cast<Real>(c[k]) * (fa - fb);
  });
  const V inverse = V(1) / (V(1) + drho);
  return {drho, {j[0] * inverse, j[1] * inverse, j[2] * inverse}};
}

/// The mean of what cells of liquid send out and of what comes in over the coming step. Velocity half-way through what
/// pressure and forces do to it: liquid at rest, which sends half a step of gravity out, has none (Guo, Zheng & Shi
/// 2002, Phys. Rev. E 65, 046308, Eq. 8).
template <class Real>
[[gnu::always_inline]] inline RowMoments<Real> moments_half_a_step_on(const std::array<Block<Real>*, 27>& around,
                                                                      int first, Parity parity) {
  using V = Row<Real>;
  V moving(0), j[3] = {V(0), V(0), V(0)};
  for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
    constexpr int i = D3Q19::forward(P);
    const V along =
        row_ahead<CX, CY, CZ>(around, parity.home(i), first) + load<V>(around[13]->f(parity.home(i)) + first);
    const V against =
        row_ahead<CX, CY, CZ>(around, parity.away(i), first) + load<V>(around[13]->f(parity.away(i)) + first);
    constexpr int c[3] = {CX, CY, CZ};
    moving += along, moving += against;
    for (int k = 0; k < 3; ++k)
      if (c[k] != 0) j[k] += static_cast<Real>(c[k]) * (along - against);
  });
  const V half(Real(0.5)), drho = load<V>(around[13]->f(0) + first) + half * moving;
  const V inverse = half / (V(1) + drho);
  return {drho, {j[0] * inverse, j[1] * inverse, j[2] * inverse}};
}

/// rho - 1 of that.
template <class Real>
Row<Real> density_half_a_step_on(const std::array<Block<Real>*, 27>& around, int first, Parity parity) {
  return moments_half_a_step_on(around, first, parity).drho;
}

/// The moments of cells; of the rows that hold wet cells. Dry cells in them hold whatever came out.
template <class Real>
struct BlockMoments {
  alignas(64) Real drho[kBlockCells];  ///< rho - 1
  alignas(64) Real u[3][kBlockCells];  ///< lu
};

/// `parity` is that of the coming step.
template <class Real>
void find_moments(const FluidGrid<Real>& grid, BlockIndex b, Parity parity, BlockMoments<Real>& moments) {
  const Block<Real>& block = grid.block(b);
  for (std::uint64_t rows = block.wet_rows; rows != 0; rows &= rows - 1) {
    const int n = kBlockWidth * std::countr_zero(rows);
    const RowMoments<Real> row = outgoing_moments_of_row(grid.around(b), n, parity);
    store_aligned(moments.drho + n, row.drho);
    for (int k = 0; k < 3; ++k) store_aligned(moments.u[k] + n, row.u[k]);
  }
}

}  // namespace lahar::lbm
