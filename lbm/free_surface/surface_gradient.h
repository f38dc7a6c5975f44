#pragma once
// The gradient of pressure at the surface, from the densities around an interface cell. It stands for the effective
// gravity g - Du/Dt: it is g in water at rest and 0 in free fall, and it is normal to the surface.
#include <utility>

#include "core/simd_math.h"
#include "lbm/free_surface/surroundings.h"
#include "lbm/grid/velocity_set.h"

namespace lahar::lbm {

/// Solves M x = b for a symmetric positive M = (xx, yy, zz, xy, xz, yz).
template <class V>
void solve_symmetric(const V (&m)[6], const V (&b)[3], V (&x)[3]) {
  const V l10 = m[3] / m[0], l20 = m[4] / m[0];
  const V d1 = m[1] - l10 * m[3], e21 = m[5] - l20 * m[3], l21 = e21 / d1;
  const V d2 = m[2] - l20 * m[4] - l21 * e21;
  const V y1 = b[1] - l10 * b[0], y2 = b[2] - l20 * b[0] - l21 * y1;
  x[2] = y2 / d2;
  x[1] = y1 / d1 - l21 * x[2];
  x[0] = b[0] / m[0] - l10 * x[1] - l20 * x[2];
}

/// grad p / rho, lu, by weighted least squares over the wet cells two links away (one where the second is not wet):
///   sum_i w_i c_i (c_i . a - (rho_far - rho_here) / (3 n_i)) = 0,  n_i = 1 or 2,
/// exact where the pressure is linear. Two links, because a sound wave of two cells, which differences over one link
/// see best, is then not seen at all: the surface fed such waves until they drowned a gravity wave
/// (docs/decisions/0007). `see(field, place)` reads the cells at a place of the surroundings as a V.
template <class V, class Real, class See>
void pressure_gradient(const Surroundings<Real>& near, int place, const See& see, V (&a)[3]) {
  const V none = number<V>(1e-6);  // in directions without wet cells the gradient is 0
  const V here = see(near.density, place);
  V m[6] = {none, none, none, V(0), V(0), V(0)}, b[3] = {V(0), V(0), V(0)};
  const auto add = [&]<int I>() __attribute__((always_inline)) {
    constexpr const int* c = D3Q19::c[I];
    constexpr int step = Surroundings<Real>::step(D3Q19::c[I][0], D3Q19::c[I][1], D3Q19::c[I][2]);
    const V once = see(near.wet, place + step), twice = once * see(near.wet, place + 2 * step);
    const V rise_once = see(near.density, place + step) - here, rise_twice = see(near.density, place + 2 * step) - here;
    const V w = number<V>(D3Q19::w(I)) * once;
    const V slope = w * (rise_once * number<V>(1.0 / 3.0) +
                         twice * (rise_twice * number<V>(1.0 / 6.0) - rise_once * number<V>(1.0 / 3.0)));
    for (int k = 0; k < 3; ++k) {
      if (c[k] == 0) continue;
      b[k] += number<V>(c[k]) * slope;
      m[k] += w;
    }
    if constexpr (c[0] * c[1] != 0) m[3] += number<V>(c[0] * c[1]) * w;
    if constexpr (c[0] * c[2] != 0) m[4] += number<V>(c[0] * c[2]) * w;
    if constexpr (c[1] * c[2] != 0) m[5] += number<V>(c[1] * c[2]) * w;
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    (add.template operator()<static_cast<int>(I) + 1>(), ...);
  }
  (std::make_index_sequence<D3Q19::q - 1>{});
  solve_symmetric(m, b, a);
}

}  // namespace lahar::lbm
