#pragma once
// Moving the populations of one velocity between a block, seen through an offset of one cell, and a contiguous buffer.
// Rows of 8 cells run along z: an offset along z takes 7 cells from one row and 1 from the next block's.
#include <cstring>

#include "lbm/block.h"

namespace lahar::lbm {

/// Calls copy(buffer row, own part, row of the block that holds the shifted row, row beyond along z) for all rows.
template <int CX, int CY, class Row>
[[gnu::always_inline]] inline void for_shifted_rows(const Row& row) {
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y) {
      const int sx = x + CX, sy = y + CY;
      const int bx = sx < 0 ? -1 : (sx > 7 ? 1 : 0), by = sy < 0 ? -1 : (sy > 7 ? 1 : 0);
      row(cell_index(x, y, 0), bx, by, cell_index(sx & 7, sy & 7, 0));
    }
}

/// buffer[n] = f_slot at n + (CX, CY, CZ). Where a block is missing the buffer gets zeros (rest at density 1).
template <int CX, int CY, int CZ, class Real>
void gather_shifted(const std::array<Block<Real>*, 27>& around, int slot, Real* __restrict buffer) {
  for_shifted_rows<CX, CY>([&](int to, int bx, int by, int from) __attribute__((always_inline)) {
    const Block<Real>* near = around[static_cast<std::size_t>(neighbour_slot(bx, by, 0))];
    Real* out = buffer + to;
    constexpr int kept = CZ == 0 ? 8 : 7;
    if (near)
      std::memcpy(out + (CZ < 0 ? 1 : 0), near->f(slot) + from + (CZ > 0 ? 1 : 0), kept * sizeof(Real));
    else
      std::memset(out + (CZ < 0 ? 1 : 0), 0, kept * sizeof(Real));
    if constexpr (CZ != 0) {
      const Block<Real>* far = around[static_cast<std::size_t>(neighbour_slot(bx, by, CZ))];
      out[CZ > 0 ? 7 : 0] = far ? far->f(slot)[from + (CZ > 0 ? 0 : 7)] : Real(0);
    }
  });
}

/// f_slot at n + (CX, CY, CZ) = buffer[n]. What would go to a missing block is dropped.
template <int CX, int CY, int CZ, class Real>
void scatter_shifted(const std::array<Block<Real>*, 27>& around, int slot, const Real* __restrict buffer) {
  for_shifted_rows<CX, CY>([&](int from, int bx, int by, int to) __attribute__((always_inline)) {
    const Block<Real>* near = around[static_cast<std::size_t>(neighbour_slot(bx, by, 0))];
    const Real* in = buffer + from;
    constexpr int kept = CZ == 0 ? 8 : 7;
    if (near) std::memcpy(near->f(slot) + to + (CZ > 0 ? 1 : 0), in + (CZ < 0 ? 1 : 0), kept * sizeof(Real));
    if constexpr (CZ != 0) {
      const Block<Real>* far = around[static_cast<std::size_t>(neighbour_slot(bx, by, CZ))];
      if (far) far->f(slot)[to + (CZ > 0 ? 0 : 7)] = in[CZ > 0 ? 7 : 0];
    }
  });
}

/// Calls visit.template operator()<pair, CX, CY, CZ>() for the nine forward velocities.
template <class Visit>
[[gnu::always_inline]] inline void for_each_pair(const Visit& visit) {
  [&]<std::size_t... P>(std::index_sequence<P...>) __attribute__((always_inline)) {
    (visit.template operator()<static_cast<int>(P), D3Q19::c[2 * P + 1][0], D3Q19::c[2 * P + 1][1],
                               D3Q19::c[2 * P + 1][2]>(),
     ...);
  }(std::make_index_sequence<D3Q19::pairs>{});
}

}  // namespace lahar::lbm
