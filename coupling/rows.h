#pragma once
// Rows of 8 cells as SIMD vectors.
#include "core/multiply_add.h"
#include "lbm/step/gather.h"

namespace lahar::coupling {

namespace stdx = std::experimental;

/// 0, 1, ... 7
template <class Real>
[[gnu::always_inline]] inline lbm::Row<Real> row_places() {
  return lbm::Row<Real>([](auto k) { return static_cast<Real>(k); });
}

}  // namespace lahar::coupling
