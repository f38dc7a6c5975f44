#pragma once
// Momentum exchanged between fluid and solids, booked on both sides.
#include <algorithm>

#include "core/archive.h"

namespace lahar::coupling {

/// Impulses in lattice units, summed over the steps. What the solids got must be what the fluid gave.
class MomentumAudit {
 public:
  void book(const Vec3& to_solids, const Vec3& from_fluid) {
    difference_ += to_solids - from_fluid;
    exchanged_ += from_fluid.cwiseAbs();
    worst_ = std::max(worst_, (to_solids - from_fluid).norm());
  }
  /// |sum of differences| over the sum of what was exchanged, 0 if nothing was.
  [[nodiscard]] double relative() const {
    const double scale = exchanged_.norm();
    return scale > 0 ? difference_.norm() / scale : 0.0;
  }
  [[nodiscard]] double worst_step() const { return worst_; }
  void transfer(Archive& archive) {
    archive.value("difference", difference_);
    archive.value("exchanged", exchanged_);
    archive.value("worst", worst_);
  }

 private:
  Vec3 difference_ = Vec3::Zero(), exchanged_ = Vec3::Zero();
  double worst_ = 0;
};

}  // namespace lahar::coupling
