#pragma once
// The cells that a piece of wire samples and gives its force to.
#include <algorithm>
#include <cmath>

#include "core/geometry.h"
#include "coupling/wires/drag_law.h"

namespace lahar::coupling {

/// The cells that the kernel around a point reaches, with its weights per axis: that of Roma et al., `scale` times as
/// wide, its sum set right where the scale is no whole number. Reach comes first, weights only for what is in water:
/// most beads of a net are not.
class WireKernel {
 public:
  void set_reach(const Vec3& place, double scale) {
    place_ = place, scale_ = scale;
    const double reach = 1.5 * scale;
    for (int a = 0; a < 3; ++a) {
      lowest_[a] = static_cast<int>(std::floor(place[a] - reach + 0.5));
      count_[a] = std::min(kMost, static_cast<int>(std::floor(place[a] + reach - 0.5)) + 1 - lowest_[a]);
    }
  }

  void set_weights() {
    for (int a = 0; a < 3; ++a) {
      double sum = 0;
      for (int k = 0; k < count_[a]; ++k)
        sum += weight_[a][k] = roma_kernel((lowest_[a] + k + 0.5 - place_[a]) / scale_);
      for (int k = 0; k < count_[a]; ++k) weight_[a][k] /= sum;
    }
  }

  [[nodiscard]] const Vec3i& lowest() const { return lowest_; }
  [[nodiscard]] Vec3i highest() const { return lowest_ + count_ - Vec3i::Ones(); }

  /// Of the k-th cell in reach along an axis.
  [[nodiscard]] double weight(int axis, int k) const { return weight_[axis][k]; }

  static constexpr int kMost = 16;  ///< cells along an axis: within three blocks, for scales up to 5

 private:
  Vec3 place_ = Vec3::Zero();  // cells
  double scale_ = 1;
  Vec3i lowest_ = Vec3i::Zero(), count_ = Vec3i::Zero();
  double weight_[3][kMost] = {};
};

}  // namespace lahar::coupling
