#pragma once
// How many wet cells have which speed: what is left of a flow's speed once its fastest drops are not counted.
#include <array>
#include <cstdint>

#include "lbm/grid/fluid_grid.h"
#include "lbm/grid/velocity_set.h"

namespace lahar::lbm {

/// Wet cells counted by a number that is at least 0: 32 classes to each factor of two, so that a class is 2.2 % wide.
class Census {
 public:
  void add(float square) { ++cells_[class_of(square)]; }
  Census& operator+=(const Census& other) {
    for (std::size_t k = 0; k < cells_.size(); ++k) cells_[k] += other.cells_[k];
    return *this;
  }
  [[nodiscard]] std::int64_t cells() const;
  /// The upper end of the lowest class above which no more than `share` of the cells are; 0 without cells. Numbers
  /// below 2^-12 count as that, those above 1 and what is not a number as 1.
  [[nodiscard]] double exceeded_by(double share) const;

 private:
  static constexpr int kOctaves = 24;          // of the square
  static constexpr int kClassesInOctave = 16;  // by the leading bits of its mantissa
  static std::size_t class_of(float square);
  std::array<std::int64_t, kOctaves * kClassesInOctave + 1> cells_{};
};

/// Lattice units.
struct SpeedCensus {
  Census speed;  ///< of the liquid as it left its cell in the last step
  Census reach;  ///< that, or what its pressure can give it, sqrt(2/3 |rho - 1|) (Bernoulli), whichever is more
};

/// Of all wet cells; does not depend on the number of threads. `parity` is that of the coming step.
template <class Real>
SpeedCensus take_speed_census(const FluidGrid<Real>& grid, Parity parity);

extern template SpeedCensus take_speed_census<float>(const FluidGrid<float>&, Parity);
extern template SpeedCensus take_speed_census<double>(const FluidGrid<double>&, Parity);

}  // namespace lahar::lbm
