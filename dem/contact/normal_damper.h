#pragma once
// The normal part that all laws share: an elastic force and a damper, never attractive. And how strong dampers may be.
#include <limits>

#include "core/simd_math.h"
#include "dem/contact/contact_state.h"

namespace lahar::dem {

/// Sets the normal force of `f` to elastic + damping x closing speed (N, N s/m), at least 0, and books the damper's
/// work.
///
/// The closing speed at the end of the step depends on all forces of the step, which are sought. The state's prediction
/// stands on those of the step before. Alone, a contact puts in the change of its own force and solves for the damper
/// (trapezoidal rule): it is stable however strong the damper, and the work that is booked is what the kick takes,
/// c v^2 dt, never negative.
///
/// With other contacts on the same bodies the dampers form the system (1/c + h G' M^-1 G) d = v, h = dt/2, G from
/// forces on contacts to forces on bodies. It is relaxed by one Jacobi step a time step, from the damping forces d of
/// the step before, with the diagonal made so large that it bounds the matrix: by the Cauchy-Schwarz inequality x' G'
/// M^-1 G x <= sum over contacts of x^2/c (C_i/m_i + C_j/m_j), C the sum of a body's dampers. So the relaxation neither
/// grows nor swings, whatever the dampers, and a lone contact is solved as before. The work of a contact may then be
/// negative while it takes up what the others left; their sum is not.
///
/// What the rule takes of the closing speed v in a step is 2 c h/m / (1 + c h/m): from c h/m = 1 on it would turn it
/// round. Dampers are as strong as that at most: such a kick takes all of it.
///
/// Without a step (dt = 0: the forces of a state before it moves) the damper's force stays as it was.
template <class V>
[[gnu::always_inline]] inline void set_normal_force(const ContactStateOf<V>& s, const V& elastic, const V& damper,
                                                    double dt, ContactHistoryOf<V>& history, ContactForceOf<V>& f) {
  const V damping =
      dt > 0 ? V(select(s.effective_mass > 0, min(damper, V(s.effective_mass * (2 / dt))), damper)) : damper;
  if (!(dt > 0)) {
    f.normal = max(elastic + history.damping_force, V{});
    f.damping = damping;
    history.normal_force = f.normal;
    history.damping_force = f.normal - elastic;
    return;
  }
  const V per_force = select(s.effective_mass > 0, 0.5 * dt / s.effective_mass, V{});  // change of the closing speed
  const V lumped = max(V(per_force * damping), V(0.5 * dt * s.damping_rate));
  const V elastic_before = history.normal_force - history.damping_force;
  const V closing = s.closing_speed - per_force * (elastic - elastic_before);
  const V damped = (damping * closing + lumped * history.damping_force) / (1 + lumped);
  f.normal = max(elastic + damped, V{});
  f.damping = damping;
  const V damping_force = f.normal - elastic;
  f.damping_work = damping_force * (closing - per_force * (damping_force - history.damping_force)) * dt;
  history.normal_force = f.normal;
  history.damping_force = damping_force;
}

/// Share of the step, 0..1, since the two touched, if that was in this step; otherwise 2.
///
/// A damper's force begins at once, or as overlap^(1/4), and the sum over steps takes its first value for a whole step,
/// whatever part of it there was contact: the restitution then scatters with the moment of the touch by dt or dt^(5/4)
/// (several per cent). Laws weigh the first value with w(share) instead, so that the sum has no such error
/// (Euler-Maclaurin with a singular end, Lyness & Ninham 1967, Math. Comput. 21:162): for a force that goes as
/// time^p, w = -zeta(-p, 1 + share) / share^p with Hurwitz' zeta function.
template <class V>
[[gnu::always_inline]] inline V share_since_touch(const ContactStateOf<V>& s, const ContactHistoryOf<V>& history,
                                                  double dt) {
  constexpr double tiny = std::numeric_limits<double>::min();
  const V share = s.overlap / max(V(dt * s.closing_speed), V(tiny));
  return select(history.normal_force > 0 || share > 1, V(2), share);
}

/// w for a constant damper: 1/2 + share.
template <class V>
[[gnu::always_inline]] inline V weight_of_constant_damper(const V& share) {
  return select(share > 1, V(1), V(0.5 + share));
}

/// w for a damper that goes as overlap^(1/4); the fit of zeta is good to 0.0016.
template <class V>
[[gnu::always_inline]] inline V weight_of_hertz_damper(const V& share) {
  const V fit = 0.3189 + share * (0.8810 + share * 0.1218);
  return select(share > 1, V(1), V(fit * inverse_root(root(share))));
}

/// A tangential damper (N s/m) that the step can follow, beside a normal one: it acts on the velocity that the forces
/// of the step before predict. A newton of it changes the slip in half a step by h/m at most if the contact is alone,
/// h = dt/2, by h (C_i/m_i + C_j/m_j)/c if all contacts of its bodies change by the like of it (see set_normal_force),
/// times 7/2, as a sphere's surface also yields by turning. Of a slip it may so take half in a whole step: with the
/// spring beside it, of 7/2 k dt^2/m = K, the slip turns round from step to step for ever where it takes 1 - K/4. None
/// without a step.
template <class V>
[[gnu::always_inline]] inline V within_step(const ContactStateOf<V>& s, const V& tangential, const V& normal,
                                            double dt) {
  constexpr double tiny = std::numeric_limits<double>::min();
  if (!(dt > 0)) return V{};
  const V per_force = select(s.tangential_mass > 0, 0.5 * dt / s.tangential_mass, V{});
  const V lumped = max(V(per_force * normal), V(0.5 * dt * s.tangential_damping_rate));
  const V mobility = select(normal > 0, lumped / normal, per_force);
  return min(tangential, V(0.25 / 3.5 / max(mobility, V(tiny))));
}

}  // namespace lahar::dem
