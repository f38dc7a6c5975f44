#include "lbm/step/speed_census.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "core/simd_math.h"
#include "lbm/grid/row_types.h"
#include "lbm/step/row_moments.h"

namespace lahar::lbm {

namespace {

constexpr int kMantissaBits = 23, kExponentBias = 127;  // of a float
constexpr std::size_t kBlocksPerPart = 256;

}  // namespace

std::size_t Census::class_of(float square) {
  static_assert(kClassesInOctave == 16);
  constexpr int first = (kExponentBias - kOctaves) * kClassesInOctave, last = kOctaves * kClassesInOctave;
  const int place = static_cast<int>(std::bit_cast<std::uint32_t>(square) >> (kMantissaBits - 4));
  return static_cast<std::size_t>(std::clamp(place - first, 0, last));
}

std::int64_t Census::cells() const { return std::accumulate(cells_.begin(), cells_.end(), std::int64_t{0}); }

double Census::exceeded_by(double share) const {
  const auto all = cells();
  if (all == 0) return 0;
  const auto spared = static_cast<std::int64_t>(share * static_cast<double>(all));
  std::size_t k = cells_.size() - 1;
  for (std::int64_t above = cells_[k]; above <= spared && k > 0; above += cells_[k]) --k;
  const auto octave = static_cast<int>(k) / kClassesInOctave, part = static_cast<int>(k) % kClassesInOctave;
  const double upper =
      k + 1 == cells_.size() ? 1.0 : std::ldexp(1.0 + (part + 1.0) / kClassesInOctave, octave - kOctaves);
  return std::sqrt(upper);
}

template <class Real>
SpeedCensus take_speed_census(const FluidGrid<Real>& grid, Parity parity) {
  const auto& owned = grid.owned();
  std::vector<SpeedCensus> parts((owned.size() + kBlocksPerPart - 1) / kBlocksPerPart);
  parallel_for_chunks(owned.size(), kBlocksPerPart, [&](std::size_t first, std::size_t last) {
    SpeedCensus& part = parts[first / kBlocksPerPart];
    for (std::size_t k = first; k < last; ++k) {
      const Block<Real>& block = grid.block(owned[k]);
      for (std::uint64_t rows = block.wet_rows; rows != 0; rows &= rows - 1) {
        const int row = std::countr_zero(rows);
        const RowMoments<Real> m = outgoing_moments_of_row(grid.around(owned[k]), kBlockWidth * row, parity);
        const Row<Real> speed = m.u[0] * m.u[0] + m.u[1] * m.u[1] + m.u[2] * m.u[2];
        const Row<Real> reach = max(speed, Real(2.0 / 3.0) * abs(m.drho));
        for (unsigned wet = wet_cells(block, row); wet != 0; wet &= wet - 1) {
          const auto lane = static_cast<std::size_t>(std::countr_zero(wet));
          part.speed.add(static_cast<float>(speed[lane]));
          part.reach.add(static_cast<float>(reach[lane]));
        }
      }
    }
  });
  SpeedCensus all;
  for (const SpeedCensus& part : parts) all.speed += part.speed, all.reach += part.reach;
  return all;
}

template SpeedCensus take_speed_census<float>(const FluidGrid<float>&, Parity);
template SpeedCensus take_speed_census<double>(const FluidGrid<double>&, Parity);

}  // namespace lahar::lbm
