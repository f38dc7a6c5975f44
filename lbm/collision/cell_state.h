#pragma once
// What one cell's collision is given and what it tells. Templates over V: a number or a pack of cells
// (core/simd.h).
// Populations are stored shifted, f_i - w_i, which keeps float rounding small (Skordos 1993).
#include <algorithm>
#include <cmath>

#include "core/simd_math.h"
#include "lbm/grid/velocity_set.h"

namespace lahar::lbm {

/// Density and velocity of a cell's incoming populations.
template <class V>
struct Moments {
  V drho;             ///< rho - 1
  V inverse_density;  ///< 1 / rho
  V u[3];             ///< momentum / rho, before any force
};

/// What acts on a cell in a step. The velocity after collision is (1 - B) (u + acceleration) + B u_s + impulse.
template <class V>
struct CellForcing {
  V acceleration[3];    ///< lu, body force per mass
  V coverage_weight;    ///< B, 0 where there is no body (collision/coverage_weight.h)
  V solid_velocity[3];  ///< u_s, lu
  V impulse[3];         ///< velocity change by impulses from outside (ImpulseFields), lu
  /// Share of the non-equilibrium part that a body takes away (SolidOperator::damped_nonequilibrium).
  V nonequilibrium_loss = V(0);
  V near_body = V(0);     ///< 1 where a body touches the cell (collision/central_moments_at_bodies.h)
  V largest_rate = V(2);  ///< the viscous moments relax no faster (collision/stress_limit.h)
  V stress_share = V(1);  ///< of the non-equilibrium part that is left after relaxation (same place)
};

template <class V>
[[gnu::always_inline]] inline Moments<V> moments(const V (&f)[D3Q19::q]) {
  const V s =
      ((f[7] + f[8]) + (f[9] + f[10])) + ((f[11] + f[12]) + (f[13] + f[14])) + ((f[15] + f[16]) + (f[17] + f[18]));
  const V drho = f[0] + ((f[1] + f[2]) + (f[3] + f[4])) + (f[5] + f[6]) + s;
  const V jx = (f[1] - f[2]) + (f[7] - f[8]) + (f[9] - f[10]) + (f[13] - f[14]) + (f[15] - f[16]);
  const V jy = (f[3] - f[4]) + (f[7] - f[8]) + (f[11] - f[12]) - (f[13] - f[14]) + (f[17] - f[18]);
  const V jz = (f[5] - f[6]) + (f[9] - f[10]) + (f[11] - f[12]) - (f[15] - f[16]) - (f[17] - f[18]);
  const V inverse = V(1) / (V(1) + drho);
  return {drho, inverse, {jx * inverse, jy * inverse, jz * inverse}};
}

/// Largest speed that a collision lets a cell leave with, lu. Far above what a time step is chosen for: only cells of a
/// splash get there, where the pressure of the lattice fluid has no physical counterpart. Such cells are counted
/// (Fluid::limited_cells).
inline constexpr double kLargestSpeed = 0.35;

/// How the cell leaves a collision.
template <class V>
struct Departure {
  V v[3];      ///< velocity, lu
  V share{1};  ///< factor by which the speed and the stress were limited, 1 nearly always
  V square;    ///< of the speed before it was limited
};

/// Cells whose speed has to be limited, or is no number.
template <class V>
[[gnu::always_inline]] inline auto too_fast(const Departure<V>& d) {
  return !(d.square <= number<V>(kLargestSpeed * kLargestSpeed));
}

template <class V>
[[gnu::always_inline]] inline Departure<V> velocity_after(const Moments<V>& m, const CellForcing<V>& force) {
  Departure<V> d;
  for (int a = 0; a < 3; ++a)
    d.v[a] = (V(1) - force.coverage_weight) * (m.u[a] + force.acceleration[a]) +
             force.coverage_weight * force.solid_velocity[a] + force.impulse[a];
  d.square = d.v[0] * d.v[0] + d.v[1] * d.v[1] + d.v[2] * d.v[2];
  if (none(too_fast(d))) [[likely]]
    return d;
  const V limit = number<V>(kLargestSpeed);
  d.share = limit / max(limit, V(sqrt(d.square)));
  for (V& component : d.v) component *= d.share;
  return d;
}

/// Symmetric second-order tensor: xx, yy, zz, xy, xz, yz.
template <class V>
struct Symmetric {
  V xx, yy, zz, xy, xz, yz;
};

/// Second central moments less their equilibrium rho/3.
template <class V>
[[gnu::always_inline]] inline Symmetric<V> second_central_moments(const V (&f)[D3Q19::q], const Moments<V>& m) {
  const V s7 = f[7] + f[8], s9 = f[9] + f[10], s11 = f[11] + f[12];
  const V s13 = f[13] + f[14], s15 = f[15] + f[16], s17 = f[17] + f[18];
  const V rho = V(1) + m.drho, third = m.drho * number<V>(1.0 / 3.0);
  const V rx = rho * m.u[0], ry = rho * m.u[1], rz = rho * m.u[2];
  return {(f[1] + f[2]) + (s7 + s9) + (s13 + s15) - third - rx * m.u[0],
          (f[3] + f[4]) + (s7 + s11) + (s13 + s17) - third - ry * m.u[1],
          (f[5] + f[6]) + (s9 + s11) + (s15 + s17) - third - rz * m.u[2],
          (s7 - s13) - rx * m.u[1],
          (s9 - s15) - rx * m.u[2],
          (s11 - s17) - ry * m.u[2]};
}

/// The same without its trace: the viscous stress.
template <class V>
[[gnu::always_inline]] inline Symmetric<V> stress(const V (&f)[D3Q19::q], const Moments<V>& m) {
  Symmetric<V> s = second_central_moments(f, m);
  const V mean = (s.xx + s.yy + s.zz) * number<V>(1.0 / 3.0);
  s.xx -= mean, s.yy -= mean, s.zz -= mean;
  return s;
}

/// S_ab S_ab
template <class V>
[[gnu::always_inline]] inline V square(const Symmetric<V>& s) {
  return s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + V(2) * (s.xy * s.xy + s.xz * s.xz + s.yz * s.yz);
}

}  // namespace lahar::lbm
