#pragma once
// Smagorinsky eddy viscosity from the local non-equilibrium (Hou, Sterling, Chen & Doolen 1996): the strain rate comes
// from the second moments, so no neighbour is read. With Q = sqrt(Pi_ab Pi_ab),
//   tau = (tau_0 + sqrt(tau_0^2 + 18 sqrt(2) Cs^2 Q / rho)) / 2.
#include <cmath>

#include "lbm/collision/cell_state.h"

namespace lahar::lbm {

template <class V>
[[gnu::always_inline]] inline V smagorinsky_rate(const Symmetric<V>& p, const V& inverse_density, const V& tau0,
                                                 const V& factor) {
  return V(2) / (tau0 + sqrt(tau0 * tau0 + factor * sqrt(square(p)) * inverse_density));
}

/// 18 sqrt(2) Cs^2.
inline double smagorinsky_factor(double cs) { return 18 * std::sqrt(2.0) * cs * cs; }

/// The viscosity model (collision/newtonian.h).
template <class V>
struct Smagorinsky {
  static constexpr bool constant = false, flow_law = false;
  V tau, factor;

  template <class Parameters>
  static Smagorinsky of(const Parameters& p) {
    return {number<V>(p.tau), number<V>(smagorinsky_factor(p.smagorinsky))};
  }
  V rate(const Symmetric<V>& s, const V& inverse_density) const {
    return smagorinsky_rate(s, inverse_density, tau, factor);
  }
};

}  // namespace lahar::lbm
