#pragma once
// The tangential part that all laws share: a spring with memory and a damper, both inside Coulomb's cone.
#include <algorithm>
#include <limits>

#include "dem/contact/contact_state.h"
#include "dem/fast_math.h"

namespace lahar::dem {

namespace detail {

/// The stored displacement in the present tangent plane: turned with the pair, length kept.
inline Triple turned_with_contact(const Triple& old, const ContactState& s, double dt) {
  Triple d = old + (s.twist_rate * dt) * cross(s.normal_ij, old);
  d = normal_part(d, s.normal_ij);
  const double old2 = dot(old, old);
  return (old2 * inverse_root(old2 * dot(d, d))) * d;
}

/// The part of a force that Coulomb's limit lets through.
inline double share_within(double limit, const Triple& force) {
  return std::min(1.0, limit * inverse_root(dot(force, force)));
}

}  // namespace detail

/// Adds the tangential force of a spring `stiffness` (N/m) and a damper `damping` (N s/m) to `f`, whose normal force
/// must be set already; advances the history.
///
/// When the stiffness grows the force is kept, when it falls the displacement is kept; either way the stored energy can
/// only fall (Thornton, Cummins & Cleary 2013, Powder Technol. 233:30, their law "with rescaling"). The spring is cut
/// at Coulomb's limit first, the damper then acts inside what is left of it, so that neither can ever add energy.
/// Slip dissipates what the mean force of the step puts in and the spring does not store: with that the ledger of a
/// half-kick-drift-half-kick step closes without an error of order dt.
inline void add_tangential_spring(const ContactState& s, double stiffness, double damping, double dt,
                                  ContactHistory& history, ContactForce& f) {
  constexpr double tiny = std::numeric_limits<double>::min();
  const double limit = s.friction * f.normal;

  const Triple old = detail::turned_with_contact(history.tangential_displacement, s, dt);
  const Triple old_force = history.tangential_stiffness * old;
  const double kept = std::min(1.0, history.tangential_stiffness / std::max(stiffness, tiny));
  const Triple step = dt * s.tangential_velocity;
  const Triple trial = kept * old + step;
  const Triple d = detail::share_within(limit, stiffness * trial) * trial;

  const Triple spring = stiffness * d;
  const Triple wish = spring + damping * s.tangential_velocity_end;
  const Triple force = detail::share_within(limit, wish) * wish;

  f.tangential = -1.0 * force;
  f.elastic_tangential = 0.5 * dot(spring, d);
  f.damping_work += dt * dot(force - spring, s.tangential_velocity_end);
  f.friction_work +=
      std::max(0.0, 0.5 * dot(spring + old_force, step) - f.elastic_tangential + 0.5 * dot(old_force, old));
  history.tangential_displacement = d;
  history.tangential_stiffness = stiffness;
}

}  // namespace lahar::dem
