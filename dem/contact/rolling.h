#pragma once
// Resistance to rolling: an elastic-plastic spring with a dashpot between the spins of two bodies in contact.
#include <algorithm>
#include <cmath>

#include "dem/contact/tangential_spring.h"

namespace lahar::dem {

/// Of a spin, what dashpots of rolling may take in a step: with a quarter a heap of grains with a restitution of 0.1
/// wins 3 % of the energy that it exchanges, with an eighth 0.5 % (Rolling.DashpotsOfACrowdMakeNoEnergy).
inline constexpr double kShareOfSpin = 0.125;

/// Rolling of one contact at one moment. Spins at mid-step and at the end of the step, for the reason in ContactState.
struct RollingState {
  Triple normal_ij{1, 0, 0};
  Triple spin{}, spin_end{};     ///< rad/s, of i relative to j; of a wall alone that of i
  double twist_rate = 0;         ///< rad/s, mean spin of the two bodies about normal_ij
  double normal_force = 0;       ///< N
  double effective_radius = 0;   ///< m, 1/R* = 1/Ri + 1/Rj
  double effective_inertia = 0;  ///< kg m^2, 1/I* = 1/(Ii + mi Ri^2) + 1/(Ij + mj Rj^2); 0 if both are held
  double shear_stiffness = 0, last_shear_stiffness = 0;  ///< N/m, of this step and of the one before
  double rolling_friction = 0;                           ///< torque that rolls on / (R* normal force)
  double damping_ratio = 0;                              ///< of critical
  /// How many dashpots like this one act on its bodies at once, >= 1: as normal dampers do (`set_normal_force`).
  double crowd = 1;
};

/// Answer of the law, and its share of the energy ledger (as in ContactForce).
struct RollingTorque {
  Triple on_i{};             ///< N m; j feels the opposite
  double elastic = 0;        ///< J, stored now
  double damping_work = 0;   ///< J, dissipated by the dashpot in this step, >= 0
  double friction_work = 0;  ///< J, dissipated by rolling on in this step, >= 0
};

/// Model C of Ai, Chen, Rotter & Ooi (2011, Powder Technol. 206:269): a spring over the relative rotation, whose torque
/// is at most rolling_friction R* F_n, and a dashpot that acts inside that limit only (their f = 0). Its stiffness is
/// k_r = k_t R*^2 (Iwashita & Oda 1998, J. Eng. Mech. 124:285), the dashpot 2 ratio sqrt(I* k_r), but no more than a
/// step can follow: it acts on spins that the torques of the step before predict, beside the tangential dampers, which
/// may take all that the step bears. So all dashpots of a sphere together take a small share of its spin in a step,
/// which answers with 2/5 m R^2 = I*/3.5.
///
/// Rolling is to the spins what sliding is to the surfaces, so that the tangential spring is used for it, with angles
/// for ways and torques for forces. Advances `angle` (rad), the elastic part of the rotation of i relative to j.
inline RollingTorque roll(const RollingState& r, Triple& angle, double dt) {
  const double lever = r.effective_radius * r.effective_radius;
  ContactState s;
  s.normal_ij = r.normal_ij;
  s.tangential_velocity = normal_part(r.spin, r.normal_ij);
  s.tangential_velocity_end = normal_part(r.spin_end, r.normal_ij);
  s.twist_rate = r.twist_rate;
  s.friction = r.rolling_friction * r.effective_radius;
  ContactForce f;
  f.normal = r.normal_force;
  ContactHistory history{angle, lever * r.last_shear_stiffness, 0, 0};
  const double stiffness = lever * r.shear_stiffness;
  const double damping = 2 * std::min(1.0, r.damping_ratio) * std::sqrt(r.effective_inertia * stiffness);
  const double bearable = dt > 0 ? kShareOfSpin * r.effective_inertia / (3.5 * r.crowd * dt) : 0.0;
  add_tangential_spring(s, stiffness, std::min(damping, bearable), dt, history, f);
  angle = history.tangential_displacement;
  return {f.tangential, f.elastic_tangential, f.damping_work, f.friction_work};
}

/// What goes to friction when a contact ends, J: what its spring still holds and what its last torque did in the step
/// that parted the two.
inline double left_by_rolling(const RollingState& r, const Triple& angle, double dt) {
  const double stiffness = r.effective_radius * r.effective_radius * r.last_shear_stiffness;
  return std::max(0.0, 0.5 * stiffness * (dot(angle, angle) + dt * dot(angle, r.spin)));
}

}  // namespace lahar::dem
