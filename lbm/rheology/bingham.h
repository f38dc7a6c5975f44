#pragma once
// Relaxation rate of a Bingham fluid, solved in closed form from the stress of the cell itself.
//
// The deviator S of the second central moments and the strain rate D are tied by S = -2/3 rho tau D, so the loading
//   q = 3 |S| / (sqrt(2) rho) = tau g,   |S| = sqrt(S_ab S_ab), g = sqrt(2 D_ab D_ab),
// is known before tau is. With tau = 1/2 + 3 (nu_p + yield / g) and g = q / tau,
//   q = (1/2 + 3 nu_p) g + 3 yield   =>   1/tau = (1 - 3 yield / q) / tau_p,
// exact, no iteration and no value of the last step. Below the yield stress (q < 3 yield) the rate of the limit
// viscosity holds; the larger of the two rates is the right one everywhere.
#include <algorithm>
#include <cmath>

#include "lbm/collision/cell_state.h"
#include "lbm/rheology/rheology.h"

namespace lahar::lbm {

/// q of a cell.
template <class V>
V loading(const Symmetric<V>& s, const V& inverse_density) noexcept {
  return sqrt(number<V>(4.5) * square(s)) * inverse_density;
}

inline constexpr double kLeastLoading = 1e-15;  ///< below it a cell is at rest

template <class V>
struct Bingham {
  static constexpr bool constant = false, flow_law = true;
  V plastic_rate;   ///< 1 / tau_p
  V yield_loading;  ///< 3 yield
  V least_rate;     ///< 1 / tau at the limit viscosity

  /// From the parameters of a sweep.
  template <class Parameters>
  static Bingham of(const Parameters& p) {
    return {number<V>(1 / (0.5 + 3 * p.rheology.consistency)), number<V>(3 * p.rheology.yield),
            number<V>(1 / p.rheology.limit_tau)};
  }

  V rate(const Symmetric<V>& s, const V& inverse_density) const {
    const V q = max(loading(s, inverse_density), number<V>(kLeastLoading));
    return max(least_rate, V((V(1) - yield_loading / q) * plastic_rate));
  }
};

}  // namespace lahar::lbm
