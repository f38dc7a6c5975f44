#pragma once
// Second-order equilibrium, shifted by the weights: f_i^eq - w_i (Qian, d'Humieres & Lallemand 1992).
#include "core/simd_math.h"
#include "lbm/grid/velocity_set.h"

namespace lahar::lbm {

/// Equilibrium of velocity i at density 1 + drho and velocity u.
template <class V>
[[gnu::always_inline]] inline V equilibrium(int i, const V& drho, const V& ux, const V& uy, const V& uz) {
  const V w = number<V>(D3Q19::w(i)), rho = V(1) + drho;
  const V cu = number<V>(D3Q19::c[i][0]) * ux + number<V>(D3Q19::c[i][1]) * uy + number<V>(D3Q19::c[i][2]) * uz;
  const V uu = ux * ux + uy * uy + uz * uz;
  return w * (drho + rho * (V(3) * cu + number<V>(4.5) * cu * cu - number<V>(1.5) * uu));
}

/// f_i^eq + f_opposite^eq, the part even in c: what anti-bounce-back needs.
template <class V>
[[gnu::always_inline]] inline V equilibrium_pair_sum(int i, const V& drho, const V& ux, const V& uy, const V& uz) {
  const V w = number<V>(D3Q19::w(i)), rho = V(1) + drho;
  const V cu = number<V>(D3Q19::c[i][0]) * ux + number<V>(D3Q19::c[i][1]) * uy + number<V>(D3Q19::c[i][2]) * uz;
  const V uu = ux * ux + uy * uy + uz * uz;
  return V(2) * w * (drho + rho * (number<V>(4.5) * cu * cu - number<V>(1.5) * uu));
}

}  // namespace lahar::lbm
