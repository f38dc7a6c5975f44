#pragma once
// Two relaxation times (Ginzburg, Verhaeghe & d'Humieres 2008): the even part of the non-equilibrium sets the
// viscosity, the odd part the place of the wall, through the magic parameter (tau+ - 1/2)(tau- - 1/2).
#include "lbm/collision/bgk.h"

namespace lahar::lbm {

struct Trt {
  static constexpr std::string_view name = "trt", meaning = "two relaxation times";
  static constexpr bool bounds_stress = false, takes_flow_laws = true, stable_without_eddies = false;
  static constexpr EquilibriumOrder equilibrium_order = EquilibriumOrder::second;
  bool operator==(const Trt&) const = default;
  static constexpr double magic_parameter = 3.0 / 16.0;  ///< half-way walls exact for Poiseuille flow

  /// The relaxation time of the odd part that belongs to one of the even part, and as a rate.
  static double odd_time(double tau) { return 0.5 + magic_parameter / (tau - 0.5); }
  template <class V>
  static V odd_rate(const V& even_rate) {
    const V half = number<V>(0.5);
    return V(1) / (half + number<V>(magic_parameter) / (V(1) / even_rate - half));
  }

  template <class Viscosity, class V>
  static Departure<V> collide(V (&f)[D3Q19::q], const Moments<V>& m, const CellForcing<V>& force,
                              const Viscosity& viscosity) {
    const V even_rate = viscous_rate(f, m, viscosity);
    const V stay = V(1) - force.nonequilibrium_loss, half = number<V>(0.5);
    const V keep_even = (V(1) - even_rate) * stay, keep_odd = (V(1) - odd_rate(even_rate)) * stay;
    const Departure<V> after = velocity_after(m, force);
    const auto& v = after.v;
    f[0] =
        equilibrium(0, m.drho, v[0], v[1], v[2]) + keep_even * (f[0] - equilibrium(0, m.drho, m.u[0], m.u[1], m.u[2]));
    for (int a = 1; a < D3Q19::q; a += 2) {
      const int b = a + 1;
      const V na = f[a] - equilibrium(a, m.drho, m.u[0], m.u[1], m.u[2]);
      const V nb = f[b] - equilibrium(b, m.drho, m.u[0], m.u[1], m.u[2]);
      const V even = keep_even * half * (na + nb), odd = keep_odd * half * (na - nb);
      f[a] = equilibrium(a, m.drho, v[0], v[1], v[2]) + even + odd;
      f[b] = equilibrium(b, m.drho, v[0], v[1], v[2]) + even - odd;
    }
    return after;
  }
};

}  // namespace lahar::lbm
