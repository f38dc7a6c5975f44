#pragma once
// Solid operators that bounce populations back instead of setting an equilibrium: for comparison with the default
// (SolidOperator). f' = f + (1 - B) (collided f - f) + B Omega_i, with
//   nonequilibrium_bounce_back  Omega_i = f_-i - f_i + f_eq,i(u_s) - f_eq,-i(u)      Noble & Torczynski 1998
//   wall_velocity_bounce_back   Omega_i = f_-i - f_i + f_eq,i(u_s) - f_eq,-i(u_s)    Holdych 2003
#include "lbm/collision/cell_state.h"
#include "lbm/collision/equilibrium.h"

namespace lahar::lbm {

template <class Operator, class Viscosity, class V>
[[gnu::noinline]] void collide_bouncing_back(V (&f)[D3Q19::q], const Moments<V>& m, const CellForcing<V>& force,
                                             const Viscosity& viscosity, bool at_wall_velocity) {
  const V b = force.coverage_weight, one(1);
  const V* u = m.u;
  const V* s = force.solid_velocity;
  V bounced[D3Q19::q];
  for (int i = 0; i < D3Q19::q; ++i) {
    const int o = i == 0 ? 0 : (i % 2 ? i + 1 : i - 1);
    const V* w = at_wall_velocity ? s : u;
    bounced[i] = f[o] + equilibrium(i, m.drho, s[0], s[1], s[2]) - equilibrium(o, m.drho, w[0], w[1], w[2]);
  }
  CellForcing<V> fluid = force;
  fluid.coverage_weight = fluid.nonequilibrium_loss = V(0);
  for (int a = 0; a < 3; ++a) fluid.impulse[a] = V(0);
  Operator::collide(f, m, fluid, viscosity);
  for (int i = 0; i < D3Q19::q; ++i) f[i] = (one - b) * f[i] + b * bounced[i];
  // Impulses act on what is left, by the exact difference of equilibria.
  const Moments<V> n = moments(f);
  for (int i = 0; i < D3Q19::q; ++i)
    f[i] += equilibrium(i, n.drho, V(n.u[0] + force.impulse[0]), V(n.u[1] + force.impulse[1]),
                        V(n.u[2] + force.impulse[2])) -
            equilibrium(i, n.drho, n.u[0], n.u[1], n.u[2]);
}

}  // namespace lahar::lbm
