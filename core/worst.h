#pragma once
// The largest of many errors, for checks that must not overlook a number that is none.
#include <cmath>

namespace lahar {

/// worst = max(worst, error); not a number stays not a number, where std::max drops it.
inline void keep_worst(double& worst, double error) {
  if (!std::isnan(worst) && !(error <= worst)) worst = error;
}

}  // namespace lahar
