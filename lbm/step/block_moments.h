#pragma once
// outgoing_moments (cell_moments.h) of the wet cells of a whole block, row by row: to look at every cell of a scene.
#include "lbm/step/gather.h"

#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// By cell; of the rows that hold wet cells. Dry cells in them hold whatever came out.
template <class Real>
struct BlockMoments {
  alignas(64) Real drho[kBlockCells];  ///< rho - 1
  alignas(64) Real u[3][kBlockCells];  ///< lu
};

/// The same numbers as outgoing_moments, to the bit. `parity` is that of the coming step.
template <class Real>
void find_moments(const FluidGrid<Real>& grid, BlockIndex b, Parity parity, BlockMoments<Real>& moments) {
  using V = Row<Real>;
  const Block<Real>& block = grid.block(b);
  const AwayPopulations<Real> ahead(grid.around(b), parity.next(), nullptr);
  for (int row = 0; row < kBlockCells / kBlockWidth; ++row) {
    if (!(block.wet_rows >> row & 1)) continue;
    const int n = kBlockWidth * row;
    const Rows rows = Rows::at(n, 1);
    V drho = load_aligned<V>(block.f(0) + n), j[3] = {V(0), V(0), V(0)};
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      const V fa = ahead.template pair<P>().template load<V>(rows);
      const V fb = load_aligned<V>(block.f(parity.away(D3Q19::forward(P))) + n);
      constexpr int c[3] = {CX, CY, CZ};
      drho += fa + fb;
      for (int k = 0; k < 3; ++k)
        if (c[k] != 0) j[k] += static_cast<Real>(c[k]) * (fa - fb);
    });
    const V inverse = V(1) / (V(1) + drho);
    store_aligned(moments.drho + n, drho);
    for (int k = 0; k < 3; ++k) store_aligned(moments.u[k] + n, j[k] * inverse);
  }
}

}  // namespace lahar::lbm
