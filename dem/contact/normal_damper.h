#pragma once
// The normal part that all laws share: an elastic force and a damper, never attractive.
#include <algorithm>

#include "dem/contact/contact_state.h"

namespace lahar::dem {

/// Sets the normal force of `f` to elastic + damping x closing speed (N, N s/m), at least 0, and books the damper's
/// work.
///
/// The closing speed at the end of the step depends on the force that is sought. The state's prediction stands on the
/// forces of the step before; the change of this contact's own force since then is put in here, solved for the damper
/// (trapezoidal rule). So a contact on its own is stable however strong its damper, and the work that is booked is what
/// the kick takes, c v^2 dt, never negative.
inline void set_normal_force(const ContactState& s, double elastic, double damping, double dt, ContactHistory& history,
                             ContactForce& f) {
  const double per_force = s.effective_mass > 0 ? 0.5 * dt / s.effective_mass : 0.0;  // change of the closing speed
  const double without = s.closing_speed + per_force * history.normal_force;
  const double closing = (without - per_force * elastic) / (1 + per_force * damping);
  f.normal = std::max(0.0, elastic + damping * closing);
  f.damping_work = (f.normal - elastic) * (without - per_force * f.normal) * dt;
  history.normal_force = f.normal;
}

}  // namespace lahar::dem
