#pragma once
// Central moments that keep the place of a wall where a body touches the cell, for BodyWeighting::wall_distance
// (docs/decisions/0033).
//
// Where a steady flow comes to rest depends on the product L = (tau - 1/2)(tau_odd - 1/2) of the viscous relaxation
// time and that of the third moments (Ginzburg, Verhaeghe & d'Humieres 2008). Central moments set the third moments to
// equilibrium, tau_odd = 1, so that L = (tau - 1/2)/2 goes to 0 with the viscosity and spheres grow: K of an array is
// three times too large at tau - 1/2 = 1e-3. At bodies the third moments are therefore handed on as TRT does. With f*
// the populations that have the density, velocity and stress of f and no other central moments, and n_i the odd part of
// f - f*, (n_i - n_opposite)/2,
//   f' = collided f + l (1 - 1/tau_odd) n,   (tau - 1/2)(tau_odd - 1/2) = 3/16.
// n holds no density, momentum or stress: it is the six third central moments, the same in a moving frame. As
// tau -> 1/2 nothing else damps them. They are limited where they are large, as by Geier, Pasquali & Schoenherr 2017
// (J. Comput. Phys. 348, 862):
//   l = kLargestThird rho / (kLargestThird rho + |n|),   |n|^2 = sum n_i^2 / w_i.
// The even moments above the stress stay at equilibrium: relaxed at 1/tau too, as by TRT, K is nearer to the reference,
// but nothing damps them as tau -> 1/2.
// A cell that no body touches collides as by the default operator, bit by bit: where blocks lie does not matter.
#include "lbm/collision/central_moments.h"
#include "lbm/collision/trt.h"

namespace lahar::lbm {

/// |n| / rho at which half of the third moments is kept. Compared in docs/decisions/0033.
inline constexpr double kLargestThird = 0.1;

/// Third central moments as populations, by pairs of opposite velocities.
template <class V>
struct ThirdMoments {
  V odd[D3Q19::pairs];
  V share;  ///< l of the head of this file
};

template <class V>
[[gnu::always_inline]] inline ThirdMoments<V> third_moments(const V (&f)[D3Q19::q], const Moments<V>& m,
                                                            const Symmetric<V>& s) {
  V g[D3Q19::q];
  from_central_moments(m.drho, m.u, s, g);
  const V half = number<V>(0.5), limit = number<V>(kLargestThird) * (V(1) + m.drho);
  ThirdMoments<V> third;
  V size(0);
  for (int p = 0; p < D3Q19::pairs; ++p) {
    third.odd[p] = half * ((f[2 * p + 1] - f[2 * p + 2]) - (g[2 * p + 1] - g[2 * p + 2]));
    size += third.odd[p] * third.odd[p] * number<V>(2 / D3Q19::w(2 * p + 1));
  }
  third.share = limit / (limit + V(sqrt(size)));
  return third;
}

struct CentralMomentsAtBodies {
  static constexpr bool bounds_stress = true, takes_flow_laws = true;

  template <class Viscosity, class V>
  [[gnu::always_inline]] static Departure<V> collide(V (&f)[D3Q19::q], const Moments<V>& m, const CellForcing<V>& force,
                                                     const Viscosity& viscosity) {
    const Symmetric<V> s = stress(f, m);
    const ThirdMoments<V> third = third_moments(f, m, s);
    const V rate = min(rate_of(viscosity, s, m.inverse_density), force.largest_rate);
    const Departure<V> after = CentralMoments::collide(f, m, force, viscosity);
    const V keep = force.near_body * third.share * (V(1) - force.nonequilibrium_loss) * force.stress_share *
                   after.share * (V(1) - Trt::odd_rate(rate));
    for (int p = 0; p < D3Q19::pairs; ++p) {
      f[2 * p + 1] += keep * third.odd[p];
      f[2 * p + 2] -= keep * third.odd[p];
    }
    return after;
  }
};

}  // namespace lahar::lbm
