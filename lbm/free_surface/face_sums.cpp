#include "lbm/free_surface/face_sums.h"

#include <bit>

#include "lbm/grid/row_types.h"
#include "lbm/step/row_moments.h"

namespace lahar::lbm {

namespace {

template <class Real>
void sum_row(const std::array<Block<Real>*, 27>& around, int first, Parity parity) {
  using V = Row<Real>;
  Block<Real>& block = *around[13];
  V sent[6] = {V(0), V(0), V(0), V(0), V(0), V(0)};
  for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
    const V fa = row_ahead<CX, CY, CZ>(around, parity.home(D3Q19::forward(P)), first);
    const V fb = load<V>(block.f(parity.away(D3Q19::forward(P))) + first);
    constexpr int c[3] = {CX, CY, CZ};
    for (int axis = 0; axis < 3; ++axis)
      if (c[axis] != 0) sent[face(axis, c[axis])] += fa, sent[face(axis, -c[axis])] += fb;
  });
  for (int k = 0; k < 6; ++k) store_aligned(block.surface->sent[k] + first, sent[k]);
}

}  // namespace

template <class Real>
void sum_over_faces(const FluidGrid<Real>& grid, BlockIndex b, Parity parity) {
  const Block<Real>& block = grid.block(b);
  for (std::uint64_t rows = block.surface->rows; rows != 0; rows &= rows - 1)
    sum_row(grid.around(b), kBlockWidth * std::countr_zero(rows), parity);
}

template void sum_over_faces<float>(const FluidGrid<float>&, BlockIndex, Parity);
template void sum_over_faces<double>(const FluidGrid<double>&, BlockIndex, Parity);

}  // namespace lahar::lbm
