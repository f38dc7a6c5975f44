#pragma once
// The normal part that all laws share: an elastic force and a damper, never attractive.
#include "core/simd_math.h"
#include "dem/contact/contact_state.h"

namespace lahar::dem {

/// Sets the normal force of `f` to elastic + damping x closing speed (N, N s/m), at least 0, and books the damper's
/// work.
///
/// The closing speed at the end of the step depends on the force that is sought. The state's prediction stands on the
/// forces of the step before; the change of this contact's own force since then is put in here, solved for the damper
/// (trapezoidal rule). So a contact on its own is stable however strong its damper, and the work that is booked is what
/// the kick takes, c v^2 dt, never negative.
template <class V>
[[gnu::always_inline]] inline void set_normal_force(const ContactStateOf<V>& s, const V& elastic, const V& damping,
                                                    double dt, ContactHistoryOf<V>& history, ContactForceOf<V>& f) {
  const V per_force = select(s.effective_mass > 0, 0.5 * dt / s.effective_mass, V{});  // change of the closing speed
  const V without = s.closing_speed + per_force * history.normal_force;
  const V closing = (without - per_force * elastic) / (1 + per_force * damping);
  f.normal = max(elastic + damping * closing, V{});
  f.damping_work = (f.normal - elastic) * (without - per_force * f.normal) * dt;
  history.normal_force = f.normal;
}

}  // namespace lahar::dem
