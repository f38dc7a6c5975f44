#pragma once
// Single relaxation time (Qian, d'Humieres & Lallemand 1992), for comparison. Forces by the exact difference of
// equilibria (Kupershtokh 2004).
#include "lbm/collision/cell_state.h"
#include "lbm/collision/smagorinsky.h"
#include "lbm/equilibrium.h"

namespace lahar::lbm {

/// The rate of the even (viscous) part: constant, or with the eddy viscosity.
template <bool kLes, class V>
V viscous_rate(const V (&f)[D3Q19::q], const Moments<V>& m, const V& tau0, const V& les_factor) {
  if constexpr (kLes) return smagorinsky_rate(second_central_moments(f, m), m.inverse_density, tau0, les_factor);
  return V(1) / tau0;
}

struct Bgk {
  static constexpr const char* name = "bgk";
  static constexpr bool bounds_stress = false;

  template <bool kLes, class V>
  static void collide(V (&f)[D3Q19::q], const Moments<V>& m, const CellForcing<V>& force, const V& tau0,
                      const V& les_factor) {
    const V omega = viscous_rate<kLes>(f, m, tau0, les_factor);
    const V keep = (V(1) - omega) * (V(1) - force.coverage_weight);
    V v[3];
    velocity_after(m, force, v);
    for (int i = 0; i < D3Q19::q; ++i)
      f[i] = equilibrium(i, m.drho, v[0], v[1], v[2]) +
             keep * (f[i] - equilibrium(i, m.drho, m.u[0], m.u[1], m.u[2]));
  }
};

}  // namespace lahar::lbm
