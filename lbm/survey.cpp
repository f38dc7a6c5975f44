#include "lbm/survey.h"

#include <cmath>

#include "core/parallel.h"
#include "lbm/collision/cell_state.h"
#include "lbm/gather.h"

namespace lahar::lbm {

namespace {

/// rho - 1 and momentum of a block's cells, from what they sent out in the last step.
template <class Real>
struct OutgoingSums {
  alignas(64) Real drho[kBlockCells], jx[kBlockCells], jy[kBlockCells], jz[kBlockCells];

  OutgoingSums(const Block<Real>& block, const std::array<Block<Real>*, 27>& around, Parity parity) {
    for (int n = 0; n < kBlockCells; ++n) drho[n] = block.f(0)[n], jx[n] = jy[n] = jz[n] = 0;
    alignas(64) Real ahead[kBlockCells];
    for_each_pair([&]<int P, int CX, int CY, int CZ>() {
      constexpr int a = D3Q19::forward(P);
      gather_shifted<CX, CY, CZ>(around, parity.home(a), block.wet_rows, ahead);
      const Real* back = block.f(parity.away(a));
      for (int row = 0; row < 64; ++row) {
        if (!(block.wet_rows >> row & 1)) continue;
        for (int n = 8 * row; n < 8 * row + 8; ++n) {
          const Real odd = ahead[n] - back[n];
          drho[n] += ahead[n] + back[n];
          if constexpr (CX != 0) jx[n] += static_cast<Real>(CX) * odd;
          if constexpr (CY != 0) jy[n] += static_cast<Real>(CY) * odd;
          if constexpr (CZ != 0) jz[n] += static_cast<Real>(CZ) * odd;
        }
      }
    });
  }
};

template <class Real>
Survey survey_block(const Block<Real>& block, const std::array<Block<Real>*, 27>& around, BlockIndex b, Parity parity) {
  Survey found;
  if (block.wet_cells == 0) return found;
  found.wet = static_cast<std::size_t>(block.wet_cells);
  const OutgoingSums<Real> sums(block, around, parity);
  for (int n = 0; n < kBlockCells; ++n) {
    if (!is_wet(block.type[static_cast<std::size_t>(n)])) continue;
    const Real inverse = Real(1) / (Real(1) + sums.drho[n]);
    const Real x = sums.jx[n] * inverse, y = sums.jy[n] * inverse, z = sums.jz[n] * inverse;
    const double speed = std::sqrt(static_cast<double>(x * x + y * y + z * z));
    found.limited += speed > 0.999 * kLargestSpeed;
    found.compression = std::max(found.compression, std::abs(static_cast<double>(sums.drho[n])));
    if (speed <= found.speed) continue;  // false for what is not a number
    found.speed = std::isfinite(speed) ? speed : kNotFinite;
    found.fastest = {b, n};
  }
  return found;
}

}  // namespace

template <class Real>
Survey survey_cells(const FluidGrid<Real>& grid, Parity parity) {
  const auto& active = grid.active();
  std::vector<Survey> of_block(active.size());
  parallel_for(0, active.size(), 8, [&](std::size_t k) {
    of_block[k] = survey_block(grid.block(active[k]), grid.around(active[k]), active[k], parity);
  });
  Survey all;
  for (const Survey& s : of_block) {
    all.limited += s.limited;
    all.wet += s.wet;
    all.compression = std::max(all.compression, s.compression);
    if (s.speed > all.speed) all.speed = s.speed, all.fastest = s.fastest;
  }
  return all;
}

template Survey survey_cells<float>(const FluidGrid<float>&, Parity);
template Survey survey_cells<double>(const FluidGrid<double>&, Parity);

}  // namespace lahar::lbm
