#pragma once
// Moving the populations of one velocity between a block, seen through an offset of one cell, and a contiguous buffer.
// Rows of 8 cells run along x: an offset along x takes 7 cells from one row and 1 from the next block's.
#include <cstring>
#include <utility>

#include "lbm/block.h"

namespace lahar::lbm {

/// A row of 8 cells, number y + 8 z of a block, seen through an offset along y and z: the blocks that hold it and its
/// first cell there.
struct ShiftedRow {
  int slot_y, slot_z;  ///< -1..1, offset of the block
  int first;           ///< first cell of the row in that block
};

template <int CY, int CZ>
[[gnu::always_inline]] constexpr ShiftedRow shifted_row(int row) {
  const int y = (row & 7) + CY, z = (row >> 3) + CZ;
  return {y < 0 ? -1 : (y > 7 ? 1 : 0), z < 0 ? -1 : (z > 7 ? 1 : 0), cell_index(0, y & 7, z & 7)};
}

/// out[k] = number k + CX of the row `near`; the one beyond its end comes from `far`, the row of the next block along
/// x. Missing rows (null) count as zeros: rest at density 1. Reads one number beyond the row, which the pool leaves
/// room for.
template <int CX, class Real>
[[gnu::always_inline]] inline void load_row(const Real* near, const Real* far, Real* __restrict out) {
  if (near)
    std::memcpy(out, near + CX, kBlockWidth * sizeof(Real));
  else
    std::memset(out, 0, kBlockWidth * sizeof(Real));
  if constexpr (CX > 0) out[7] = far ? far[0] : Real(0);
  if constexpr (CX < 0) out[0] = far ? far[7] : Real(0);
}

/// Where a velocity's numbers of a shifted row lie; null where the block is missing.
template <class Real>
[[gnu::always_inline]] inline Real* row_of(const std::array<Block<Real>*, 27>& around, int dx, const ShiftedRow& row,
                                           int slot) {
  const Block<Real>* block = around[static_cast<std::size_t>(neighbour_slot(dx, row.slot_y, row.slot_z))];
  return block ? block->f(slot) + row.first : nullptr;
}

/// Rows by bit y + 8 z.
inline constexpr std::uint64_t kAllRows = ~std::uint64_t{0};

/// buffer[n] = f_slot at n + (CX, CY, CZ) in the given rows.
template <int CX, int CY, int CZ, class Real>
void gather_shifted(const std::array<Block<Real>*, 27>& around, int slot, std::uint64_t rows, Real* __restrict buffer) {
  for (int r = 0; r < 64; ++r) {
    if (!(rows >> r & 1)) continue;
    const ShiftedRow row = shifted_row<CY, CZ>(r);
    const Real* far = CX == 0 ? nullptr : row_of(around, CX, row, slot);
    load_row<CX>(row_of(around, 0, row, slot), far, buffer + 8 * r);
  }
}

/// f_slot at n + (CX, CY, CZ) = buffer[n] in the given rows. What would go to a missing block is dropped.
template <int CX, int CY, int CZ, class Real>
void scatter_shifted(const std::array<Block<Real>*, 27>& around, int slot, std::uint64_t rows,
                     const Real* __restrict buffer) {
  for (int r = 0; r < 64; ++r) {
    if (!(rows >> r & 1)) continue;
    const ShiftedRow row = shifted_row<CY, CZ>(r);
    const Real* in = buffer + 8 * r;
    constexpr int kept = CX == 0 ? 8 : 7;
    if (Real* near = row_of(around, 0, row, slot))
      std::memcpy(near + (CX > 0 ? 1 : 0), in + (CX < 0 ? 1 : 0), kept * sizeof(Real));
    if constexpr (CX != 0)
      if (Real* far = row_of(around, CX, row, slot)) far[CX > 0 ? 0 : 7] = in[CX > 0 ? 7 : 0];
  }
}

/// Calls visit.template operator()<pair, CX, CY, CZ>() for the nine forward velocities.
template <class Visit>
[[gnu::always_inline]] inline void for_each_pair(const Visit& visit) {
  [&]<std::size_t... P>(std::index_sequence<P...>) __attribute__((always_inline)) {
    (visit.template
     operator()<static_cast<int>(P), D3Q19::c[2 * P + 1][0], D3Q19::c[2 * P + 1][1], D3Q19::c[2 * P + 1][2]>(),
     ...);
  }
  (std::make_index_sequence<D3Q19::pairs>{});
}

}  // namespace lahar::lbm
