#pragma once
// The default operator: central moments on D3Q19 with the deviatoric second moments relaxed at omega and everything
// else (the trace and all moments above second order) set to equilibrium. Stable without an eddy viscosity down to
// tau - 1/2 = 1e-6 (docs/decisions/0004). Geier, Greiner & Korvink 2006 for the method; the equilibrium central moments
// are those of the Maxwell distribution: third order 0, fourth order rho/9 (De Rosis 2016).
//
// Only density, velocity and six second moments survive a collision, so no 19 x 19 transform is needed: the populations
// after it are written directly from the raw moments
//   m_aab  = rho v_a^2 v_b + 2 v_a S_ab + v_b (rho/3 + S_aa)
//   m_aabb = rho v_a^2 v_b^2 + v_b^2 (rho/3 + S_aa) + v_a^2 (rho/3 + S_bb) + 4 v_a v_b S_ab + rho/9 + (S_aa + S_bb)/2
// with v the velocity after the forces and S the relaxed deviator. The last term is what the lattice itself gives to
// the fourth moments when S is carried by the second-order polynomials alone (sum_i w_i c_ia^4 c_ib^2 = 1/9 on D3Q19):
// the fourth-order modes that are set to equilibrium are then orthogonal to the stress. Without it the fluid at rest is
// linearly unstable at small viscosity (noise of 1e-6 grew to 5e-2 in 4000 steps at nu = 1e-6; with 1/3, the value of
// the Maxwell distribution, it still grew five-fold in 6000; with 1/2 it decays). Forces shift the frame in which the
// central moments are taken, which is exact up to the square of the force.
//
// Moving frames: c_a^3 = c_a, so the third moment along an axis is rho v_a where it should be rho (v_a + v_a^3), and
// the momentum balance of second order misses d_a (rho v_a^3) = 3 rho v_a^2 d_a v_a in the stress: the viscosity of
// stretching along an axis is lower by the share 9/2 v_a^2. A source C in the second moments acts with the weight tau
// on the stress and the missing term with tau - 1/2, so C_aa = -(1 - omega/2) 3 rho v_a^2 d_a v_a puts it back (Geier,
// Schoenherr, Pasquali & Krafczyk 2015, Comput. Math. Appl. 70, eqs. 61-66). The strain rate d_a v_a = -3 omega /
// (2 rho) s_a comes from the stress, which now holds half of the missing term: up to v^4, and without the divergence,
//   s_a = S_aa + 9/4 omega (v_a^2 S_aa - mean over the axes),
//   S_aa -> (1 - omega) S_aa + 9/2 omega (1 - omega/2) v_a^2 s_a, less the mean over the axes.
// It vanishes with the viscosity. The missing moment c_x c_y c_z is not put back: its derivatives are not in S.
#include <string_view>

#include "lbm/collision/cell_state.h"
#include "lbm/collision/equilibrium.h"
#include "lbm/collision/newtonian.h"

namespace lahar::lbm {

/// Writes the populations with given density, velocity and deviatoric second central moments.
template <class V>
[[gnu::always_inline]] inline void from_central_moments(const V& drho, const V (&v)[3], const Symmetric<V>& s,
                                                        V (&f)[D3Q19::q]) {
  const V rho = V(1) + drho, half = number<V>(0.5), quarter = number<V>(0.25);
  const V third = rho * number<V>(1.0 / 3.0), dthird = drho * number<V>(1.0 / 3.0),
          dninth = drho * number<V>(1.0 / 9.0);
  const V vx = v[0], vy = v[1], vz = v[2];
  const V jx = rho * vx, jy = rho * vy, jz = rho * vz;
  const V px = third + s.xx, py = third + s.yy, pz = third + s.zz;
  const V jxvx = jx * vx, jyvy = jy * vy, jzvz = jz * vz, jxvy = jx * vy, jxvz = jx * vz, jyvz = jy * vz;
  const V xx = dthird + s.xx + jxvx, yy = dthird + s.yy + jyvy, zz = dthird + s.zz + jzvz;
  const V xy = s.xy + jxvy, xz = s.xz + jxvz, yz = s.yz + jyvz;
  const V two(2), four(4);
  const V xxy = vx * (jxvy + two * s.xy) + vy * px, xyy = vy * (jxvy + two * s.xy) + vx * py;
  const V xxz = vx * (jxvz + two * s.xz) + vz * px, xzz = vz * (jxvz + two * s.xz) + vx * pz;
  const V yyz = vy * (jyvz + two * s.yz) + vz * py, yzz = vz * (jyvz + two * s.yz) + vy * pz;
  const V xxyy = dninth + half * (s.xx + s.yy) + vy * vy * px + vx * vx * py + vx * vy * (jxvy + four * s.xy);
  const V xxzz = dninth + half * (s.xx + s.zz) + vz * vz * px + vx * vx * pz + vx * vz * (jxvz + four * s.xz);
  const V yyzz = dninth + half * (s.yy + s.zz) + vz * vz * py + vy * vy * pz + vy * vz * (jyvz + four * s.yz);

  f[0] = drho - (xx + yy + zz) + (xxyy + xxzz + yyzz);
  const V ex = half * (xx - xxyy - xxzz), ox = half * (jx - xyy - xzz);
  const V ey = half * (yy - xxyy - yyzz), oy = half * (jy - xxy - yzz);
  const V ez = half * (zz - xxzz - yyzz), oz = half * (jz - xxz - yyz);
  f[1] = ex + ox, f[2] = ex - ox;
  f[3] = ey + oy, f[4] = ey - oy;
  f[5] = ez + oz, f[6] = ez - oz;
  f[7] = quarter * ((xxyy + xy) + (xyy + xxy)), f[8] = quarter * ((xxyy + xy) - (xyy + xxy));
  f[13] = quarter * ((xxyy - xy) + (xyy - xxy)), f[14] = quarter * ((xxyy - xy) - (xyy - xxy));
  f[9] = quarter * ((xxzz + xz) + (xzz + xxz)), f[10] = quarter * ((xxzz + xz) - (xzz + xxz));
  f[15] = quarter * ((xxzz - xz) + (xzz - xxz)), f[16] = quarter * ((xxzz - xz) - (xzz - xxz));
  f[11] = quarter * ((yyzz + yz) + (yzz + yyz)), f[12] = quarter * ((yyzz + yz) - (yzz + yyz));
  f[17] = quarter * ((yyzz - yz) + (yzz - yyz)), f[18] = quarter * ((yyzz - yz) - (yzz - yyz));
}

/// Relaxes the diagonal of a stress in a moving frame (head of this file): keeps (1 - omega) of it, corrected for v.
template <class V>
[[gnu::always_inline]] inline void relax_diagonal(const V& omega, const V (&v)[3], Symmetric<V>& s) {
  const V keep = V(1) - omega, cubic = number<V>(4.5) * omega * (V(1) - number<V>(0.5) * omega);
  const V x2 = v[0] * v[0], y2 = v[1] * v[1], z2 = v[2] * v[2], third = number<V>(1.0 / 3.0);
  const V x = x2 * s.xx, y = y2 * s.yy, z = z2 * s.zz, part = number<V>(2.25) * omega, even = (x + y + z) * third;
  s.xx = keep * s.xx + cubic * (x + x2 * part * (x - even));
  s.yy = keep * s.yy + cubic * (y + y2 * part * (y - even));
  s.zz = keep * s.zz + cubic * (z + z2 * part * (z - even));
  const V mean = (s.xx + s.yy + s.zz) * third;
  s.xx -= mean, s.yy -= mean, s.zz -= mean;
}

struct CentralMoments {
  static constexpr std::string_view name = "central_moments",
                                    meaning = "moments about the velocity, relaxed one by one";
  static constexpr bool bounds_stress = true, takes_flow_laws = true, stable_without_eddies = true;
  static constexpr EquilibriumOrder equilibrium_order = EquilibriumOrder::fourth;
  bool operator==(const CentralMoments&) const = default;

  template <class Viscosity, class V>
  [[gnu::always_inline]] static Departure<V> collide(V (&f)[D3Q19::q], const Moments<V>& m, const CellForcing<V>& force,
                                                     const Viscosity& viscosity) {
    Symmetric<V> s = stress(f, m);
    const V omega = min(rate_of(viscosity, s, m.inverse_density), force.largest_rate);
    const Departure<V> after = velocity_after(m, force);
    const V share = (V(1) - force.nonequilibrium_loss) * force.stress_share * after.share,
            keep = (V(1) - omega) * share;
    relax_diagonal(omega, after.v, s);
    for (V* t : {&s.xx, &s.yy, &s.zz}) *t *= share;
    for (V* t : {&s.xy, &s.xz, &s.yz}) *t *= keep;
    from_central_moments(m.drho, after.v, s, f);
    return after;
  }
};

}  // namespace lahar::lbm
