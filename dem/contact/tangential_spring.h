#pragma once
// The tangential part that all laws share: a spring with memory and a damper, both inside Coulomb's cone.
#include <limits>

#include "core/simd_math.h"
#include "dem/contact/contact_state.h"

namespace lahar::dem {

namespace detail {

/// The stored displacement in the present tangent plane: turned with the pair, length kept.
template <class V>
[[gnu::always_inline]] inline TripleOf<V> turned_with_contact(const TripleOf<V>& old, const ContactStateOf<V>& s,
                                                              double dt) {
  TripleOf<V> d = old + V(s.twist_rate * dt) * cross(s.normal_ij, old);
  d = normal_part(d, s.normal_ij);
  const V old2 = dot(old, old);
  return V(old2 * inverse_root(V(old2 * dot(d, d)))) * d;
}

/// The part of a force that Coulomb's limit lets through.
template <class V>
[[gnu::always_inline]] inline V share_within(const V& limit, const TripleOf<V>& force) {
  return min(V(limit * inverse_root(dot(force, force))), V(1));
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
template <class V>
[[gnu::always_inline]] inline void add_tangential_spring(const ContactStateOf<V>& s, const V& stiffness,
                                                         const V& damping, double dt, ContactHistoryOf<V>& history,
                                                         ContactForceOf<V>& f) {
  constexpr double tiny = std::numeric_limits<double>::min();
  const V limit = s.friction * f.normal;

  const TripleOf<V> old = detail::turned_with_contact(history.tangential_displacement, s, dt);
  const TripleOf<V> old_force = history.tangential_stiffness * old;
  const V kept = min(V(history.tangential_stiffness / max(stiffness, V(tiny))), V(1));
  const TripleOf<V> step = dt * s.tangential_velocity;
  const TripleOf<V> trial = kept * old + step;
  const TripleOf<V> d = detail::share_within(limit, stiffness * trial) * trial;

  const TripleOf<V> spring = stiffness * d;
  const TripleOf<V> wish = spring + damping * s.tangential_velocity_end;
  const TripleOf<V> force = detail::share_within(limit, wish) * wish;

  f.tangential = -1.0 * force;
  f.elastic_tangential = 0.5 * dot(spring, d);
  f.damping_work += dt * dot(force - spring, s.tangential_velocity_end);
  f.friction_work +=
      max(V(0.5 * dot(spring + old_force, step) - f.elastic_tangential + 0.5 * dot(old_force, old)), V{});
  history.tangential_displacement = d;
  history.tangential_stiffness = stiffness;
}

}  // namespace lahar::dem
