#pragma once
// What a contact law sees and what it answers. Geometry and loops live elsewhere: a law is a pure function of these.
#include <concepts>

#include "dem/triple.h"

namespace lahar::dem {

/// One contact at one moment. Side j is a second sphere or a wall (radius and mass infinite).
///
/// Positions are those at the end of a time step. Displacements over the step need the velocity at its middle, dampers
/// the velocity at its end, so both are given: mixing them up turns springs into (negative) dampers of order dt.
struct ContactState {
  double overlap = 0;                  ///< m, > 0 in contact
  double closing_speed = 0;            ///< m/s at the end of the step if all forces stayed; > 0 while the overlap grows
  Triple normal_ij{1, 0, 0};           ///< unit, from i to j
  Triple tangential_velocity{};        ///< m/s at mid-step, surface of i relative to j, normal to normal_ij
  Triple tangential_velocity_end{};    ///< the same at the end of the step
  double twist_rate = 0;               ///< rad/s, mean spin of the two bodies about normal_ij
  double effective_radius = 0;         ///< m, 1/R* = 1/Ri + 1/Rj
  double effective_mass = 0;           ///< kg, 1/m* = 1/mi + 1/mj
  double effective_modulus = 0;        ///< Pa, E*
  double effective_shear_modulus = 0;  ///< Pa, G*
  double friction = 0;                 ///< Coulomb coefficient
  double damping_ratio = 0;            ///< of critical, see damping.h
};

/// What a contact remembers. All zero when a contact begins.
struct ContactHistory {
  Triple tangential_displacement{};  ///< m, elastic part, of i relative to j
  double tangential_stiffness = 0;   ///< N/m, of the step before
  double normal_force = 0;           ///< N, of the step before
};

/// Answer of a law, and its share of the energy ledger.
struct ContactForce {
  double normal = 0;              ///< N, >= 0, pushes i along -normal_ij
  Triple tangential{};            ///< N, on i
  double elastic_normal = 0;      ///< J, stored now
  double elastic_tangential = 0;  ///< J, stored now
  double damping_work = 0;        ///< J, dissipated by dampers in this step, >= 0
  double friction_work = 0;       ///< J, dissipated by slip in this step, >= 0
};

/// A contact law: state and history in, force out; the history is advanced by one time step `dt` (s).
template <class L>
concept ContactLaw = requires(const L& law, const ContactState& state, ContactHistory& history, double dt) {
  { law(state, history, dt) } -> std::same_as<ContactForce>;
};

}  // namespace lahar::dem
