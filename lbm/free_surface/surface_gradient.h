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

/// The gradient of pressure over density where the pressure at the centre is not known: what it is if the surface runs
/// through the centre, less so much for a pressure over density of 1 there.
template <class V>
struct PressureFit {
  V at_surface[3], per_depth[3];
};

/// What pressure_gradient is told.
template <class V>
struct KnownPressure {
  typename V::mask_type layer;  ///< cells on a layer of liquid: their own density does not count
  V surface;                    ///< rho - 1 on the surface
  V gravity[3];                 ///< lu
};

/// grad p / rho, lu, by weighted least squares over the wet cells two links away (one where the second is not wet):
///   sum_i w_i c_i (c_i . a - (p_far - p_here) / n_i) = 0,  n_i = 1 or 2, p = rho / 3,
/// exact where the pressure is linear. Two links, because a sound wave of two cells, which differences over one link
/// see best, is then not seen at all: the surface fed such waves until they drowned a gravity wave
/// (docs/decisions/0007). Of a cell on a layer of liquid, p_here stands for the depth of its centre below the surface
/// (PressureFit) towards cells of liquid: its own density follows from the gradient of the step before, which fed sound
/// between the surface and the bed. Where a layer has one cell of liquid on a wall, what the wall holds is weight.
/// (docs/decisions/0089)
/// Layers: whether any of the cells are on one; if not, what only they need is left out.
template <bool Layers, class V>
[[gnu::always_inline]] inline PressureFit<V> pressure_gradient(const Sight<V>& sight, const KnownPressure<V>& known) {
  const V none = number<V>(1e-6), zero(0);  // in directions without wet cells the gradient is 0
  const V here = sight.template density<0, 0, 0>();
  V m[6] = {none, none, none, zero, zero, zero}, b[3] = {zero, zero, zero}, v[3] = {zero, zero, zero};
  const auto add = [&]<int CX, int CY, int CZ>(double weight) __attribute__((always_inline)) {
    const auto once = sight.template wet<CX, CY, CZ>(), twice = once && sight.template wet<2 * CX, 2 * CY, 2 * CZ>();
    const V rise_once = sight.template density<CX, CY, CZ>() - here,
            far = sight.template density<2 * CX, 2 * CY, 2 * CZ>();
    V rise_twice = far - here;
    constexpr int c[3] = {CX, CY, CZ};
    if constexpr (Layers) {
      const auto by_surface = known.layer && twice && sight.template liquid<2 * CX, 2 * CY, 2 * CZ>();
      rise_twice =
          select(by_surface, sight.template density_half_way<2 * CX, 2 * CY, 2 * CZ>() - known.surface, rise_twice);
      const V half_weight = select(by_surface, number<V>(weight / 2), zero);
      for (int k = 0; k < 3; ++k)
        if (c[k] != 0) v[k] += number<V>(c[k]) * half_weight;
    }
    V slope = select(once, select(twice, number<V>(weight / 6) * rise_twice, number<V>(weight / 3) * rise_once), zero);
    V w = select(once, number<V>(weight), zero);
    if constexpr (Layers) {
      const auto on_wall = known.layer && sight.template liquid<CX, CY, CZ>() && !twice &&
                           !sight.template empty<2 * CX, 2 * CY, 2 * CZ>();
      V weight_along(0);
      for (int k = 0; k < 3; ++k)
        if (c[k] != 0) weight_along += number<V>(weight * c[k]) * known.gravity[k];
      constexpr bool axis = CX * CX + CY * CY + CZ * CZ == 1;
      slope = select(on_wall, axis ? weight_along : zero, slope);
      if constexpr (!axis) w = select(on_wall, zero, w);
    }
    for (int k = 0; k < 3; ++k)
      if (c[k] != 0) b[k] += number<V>(c[k]) * slope, m[k] += w;
    if constexpr (CX * CY != 0) m[3] += number<V>(CX * CY) * w;
    if constexpr (CX * CZ != 0) m[4] += number<V>(CX * CZ) * w;
    if constexpr (CY * CZ != 0) m[5] += number<V>(CY * CZ) * w;
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    (add.template operator()<D3Q19::c[I + 1][0], D3Q19::c[I + 1][1], D3Q19::c[I + 1][2]>(D3Q19::w(I + 1)), ...);
  }
  (std::make_index_sequence<D3Q19::q - 1>{});
  PressureFit<V> fit;
  solve_symmetric(m, b, fit.at_surface);
  if constexpr (Layers)
    solve_symmetric(m, v, fit.per_depth);
  else
    for (V& component : fit.per_depth) component = zero;
  return fit;
}

}  // namespace lahar::lbm
