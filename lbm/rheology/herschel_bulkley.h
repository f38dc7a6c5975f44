#pragma once
// Relaxation rate of a Herschel-Bulkley fluid, solved from the stress of the cell itself. With the loading q = tau g of
// bingham.h the shear rate g is the root of
//   h(g) = g/2 + 3 K g^n = q - 3 yield =: e,
// and 1/tau = g / q. In x = log2 g the function log2 h(x) - log2 e rises everywhere with a slope between 1 and n and is
// convex (the logarithm of a sum of exponentials): Newton's method from a point above the root falls to it without ever
// passing it. Such a point is min(2 e, (e / 3K)^(1/n)), at most one binary order off in h; five steps leave a relative
// error of the shear rate below 1e-7 for n from 0.3 to 2 (tests/lbm/rheology/rheology_test.cpp). A fixed number of
// steps, the same for all lanes; log2 (h/e), between 0 and 1, by the first terms of its series, which are exact where
// it counts, at the root.
#include "lbm/rheology/bingham.h"
#include "lbm/rheology/power.h"

namespace lahar::lbm {

template <class V>
struct HerschelBulkley {
  static constexpr bool constant = false, flow_law = true;
  static constexpr int newton_steps = 5;
  V exponent;         ///< n
  V log_consistency;  ///< log2(3 K)
  V yield_loading;    ///< 3 yield
  V least_rate;       ///< 1 / tau at the limit viscosity

  template <class Parameters>
  static HerschelBulkley of(const Parameters& p) {
    return {number<V>(p.rheology.exponent), number<V>(std::log2(3 * p.rheology.consistency)),
            number<V>(3 * p.rheology.yield), number<V>(1 / p.rheology.limit_tau)};
  }

  /// g from e.
  V shear_rate(const V& excess) const {
    const V target = log2_of(excess), shift = log_consistency - target;
    // No rate is below 2^-100, where exp2_of ends: that of the limit viscosity counts long before.
    V x = max(min(V(target + V(1)), V(-shift / exponent)), V(-100));
    for (int k = 0; k < newton_steps; ++k) {
      const V viscous = exp2_of(V(x - V(1) - target)), plastic = exp2_of(V(exponent * x + shift));
      const V ratio = viscous + plastic, s = (ratio - V(1)) / (ratio + V(1)), s2 = s * s;
      const V above = number<V>(2 / 0.69314718055994530942) * s *
                      (V(1) + s2 * (number<V>(1.0 / 3) + s2 * (number<V>(0.2) + s2 * number<V>(1.0 / 7))));
      x = max(V(x - above * ratio / (viscous + exponent * plastic)), V(-100));
    }
    return exp2_of(x);
  }

  V rate(const Symmetric<V>& s, const V& inverse_density) const {
    const V least = number<V>(kLeastLoading), q = max(loading(s, inverse_density), least);
    return max(least_rate, V(shear_rate(max(V(q - yield_loading), least)) / q));
  }
};

}  // namespace lahar::lbm
