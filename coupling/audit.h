#pragma once
// Momentum exchanged between fluid and solids, booked on both sides.
#include <algorithm>

#include "core/archive.h"

namespace lahar::coupling {

/// Impulses in a step, lu: what the solids got, summed over solids, and what the fluid gave, summed over cells.
struct ExchangedMomentum {
  Vec3 to_solids = Vec3::Zero(), from_fluid = Vec3::Zero();
  ExchangedMomentum& operator+=(const ExchangedMomentum& o) {
    to_solids += o.to_solids, from_fluid += o.from_fluid;
    return *this;
  }
};

/// Impulses in lattice units, summed over the steps. What the solids got must be what the fluid gave.
class MomentumAudit {
 public:
  void book(const ExchangedMomentum& step) {
    difference_ += step.to_solids - step.from_fluid;
    exchanged_ += step.from_fluid.cwiseAbs();
  }
  /// |sum of differences| over the sum of what the fluid gave, at most 1: what the solids got of nothing. 0 if nothing
  /// was exchanged.
  [[nodiscard]] double relative() const {
    const double scale = std::max(exchanged_.norm(), difference_.norm());
    return scale <= 0 ? 0.0 : difference_.norm() / scale;  // NaN stays NaN
  }
  void transfer(Archive& archive) {
    archive.value("difference", difference_);
    archive.value("exchanged", exchanged_);
  }

 private:
  Vec3 difference_ = Vec3::Zero(), exchanged_ = Vec3::Zero();
};

}  // namespace lahar::coupling
