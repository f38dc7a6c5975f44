#pragma once
// Single relaxation time (Qian, d'Humieres & Lallemand 1992), for comparison. Forces by the exact difference of
// equilibria (Kupershtokh 2004).
#include <string_view>

#include "lbm/collision/cell_state.h"
#include "lbm/collision/equilibrium.h"
#include "lbm/collision/newtonian.h"

namespace lahar::lbm {

/// The rate of the even (viscous) part: constant, or from the cell's stress; of flow laws from its deviator.
template <class Viscosity, class V>
V viscous_rate(const V (&f)[D3Q19::q], const Moments<V>& m, const Viscosity& viscosity) {
  if constexpr (Viscosity::constant)
    return viscosity.rate();
  else if constexpr (Viscosity::flow_law)
    return viscosity.rate(stress(f, m), m.inverse_density);
  else
    return viscosity.rate(second_central_moments(f, m), m.inverse_density);
}

struct Bgk {
  static constexpr std::string_view name = "bgk", meaning = "one relaxation time";
  static constexpr bool bounds_stress = false, stable_without_eddies = false;
  static constexpr EquilibriumOrder equilibrium_order = EquilibriumOrder::second;
  static constexpr bool takes_flow_laws = false;  ///< its walls slip where the viscosity is large
  bool operator==(const Bgk&) const = default;

  template <class Viscosity, class V>
  static Departure<V> collide(V (&f)[D3Q19::q], const Moments<V>& m, const CellForcing<V>& force,
                              const Viscosity& viscosity) {
    const V omega = viscous_rate(f, m, viscosity);
    const V keep = (V(1) - omega) * (V(1) - force.nonequilibrium_loss);
    const Departure<V> after = velocity_after(m, force);
    const auto& v = after.v;
    for (int i = 0; i < D3Q19::q; ++i)
      f[i] = equilibrium(i, m.drho, v[0], v[1], v[2]) + keep * (f[i] - equilibrium(i, m.drho, m.u[0], m.u[1], m.u[2]));
    return after;
  }
};

}  // namespace lahar::lbm
