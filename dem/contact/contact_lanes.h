#pragma once
// Possible contacts side by side, in the lanes of a pack: their geometry, and the law on it.
#include <algorithm>

#include "core/simd_math.h"
#include "core/triple.h"
#include "dem/contact/contact_state.h"

namespace lahar::dem {

/// As many as the processor's vectors hold, four at least: more would leave their numbers on the stack (0040, 0075).
inline constexpr std::size_t kContactLanes = std::clamp<std::size_t>(kNativeLanes<double>, 4, kRow);
using Lanes = Pack<double, kContactLanes>;
using Lanes3 = TripleOf<Lanes>;

/// Possible contacts. Side j is a sphere or a wall, which has no spin, radius or inverse mass.
struct ContactLanes {
  Lanes3 normal{};             ///< from i to j
  Lanes overlap{};             ///< m
  Lanes::mask_type touches{};  ///< lanes that do not touch answer zero
  Lanes3 slip{}, slip_end{};   ///< m/s, of i's centre relative to j, at mid-step and at the end of the step
  Lanes3 spin{};               ///< rad/s, sum of both spheres, at mid-step
  Lanes3 rim{}, rim_end{};     ///< m/s, sum of radius x spin, at mid-step and at the end of the step
  Lanes inverse_mass{}, tangential_inverse_mass{};                ///< 1/kg, sums of both, see ContactState
  Lanes damping_rate{}, tangential_damping_rate{};                ///< 1/s, see ContactState
  Lanes effective_radius{};                                       ///< m
  Lanes modulus{}, shear_modulus{}, friction{}, damping_ratio{};  ///< see ContactState

  /// From the vector from centre j to centre i and the sum of radii (m): normal, overlap and whether they touch.
  [[gnu::always_inline]] void set_spheres(const Lanes3& between, const Lanes& radii) {
    const Lanes square = dot(between, between);
    const Lanes inverse = inverse_root(square);
    normal = Lanes(-inverse) * between;
    touches = square < radii * radii;  // not where a particle was removed, whose position is not a number
    // Touching was judged on squares: by rounding the difference may be a hair below zero, and a root is taken of it.
    overlap = max(radii - square * inverse, Lanes{});
  }
};

/// What they answer; zero where they do not touch, but for what the end of a contact leaves to friction.
struct AnswerLanes {
  Lanes3 force, twist;                ///< N, on i; the torque on either sphere is its arm x twist
  Lanes damper;                       ///< N s/m, of the normal damper
  Lanes damping_work, friction_work;  ///< J
};

/// What goes to friction when a contact ends, J: what its spring still holds, and what its last force did in the step
/// that parted the two. Nothing of the latter where a particle was removed, whose motion is not a number.
[[gnu::always_inline]] inline Lanes left_by_spring(const ContactStateOf<Lanes>& s, const ContactHistoryOf<Lanes>& h,
                                                   double dt) {
  const Lanes half = 0.5 * h.tangential_stiffness;
  const Lanes held = half * dot(h.tangential_displacement, h.tangential_displacement);
  const Lanes last = half * dt * dot(h.tangential_displacement, s.tangential_velocity);
  return max(held + select(last == last, last, Lanes{}), Lanes{});
}

/// Evaluates contacts and advances what they remember by `dt` (s).
template <ContactLaw L>
[[gnu::always_inline]] inline AnswerLanes evaluate(const ContactLanes& c, ContactHistoryOf<Lanes>& history,
                                                   const L& law, double dt) {
  const Lanes3& n = c.normal;
  const Lanes half = 0.5 * c.overlap;  // the arms are the radii less half the overlap
  const Lanes3 turning = cross(c.rim - half * c.spin, n);
  const Lanes3 turning_end = cross(c.rim_end - half * c.spin, n);  // what half an overlap takes off the arms is small

  ContactStateOf<Lanes> s;
  s.overlap = c.overlap;
  s.closing_speed = dot(c.slip_end, n);
  s.normal_ij = n;
  s.tangential_velocity = normal_part(c.slip, n) + turning;
  s.tangential_velocity_end = (c.slip_end - s.closing_speed * n) + turning_end;
  s.twist_rate = 0.5 * dot(c.spin, n);
  s.effective_radius = c.effective_radius;
  s.effective_mass = select(c.inverse_mass > 0, 1.0 / c.inverse_mass, Lanes{});
  s.tangential_mass = select(c.tangential_inverse_mass > 0, 1.0 / c.tangential_inverse_mass, Lanes{});
  s.effective_modulus = c.modulus;
  s.effective_shear_modulus = c.shear_modulus;
  s.friction = c.friction;
  s.damping_ratio = c.damping_ratio;
  s.damping_rate = c.damping_rate;
  s.tangential_damping_rate = c.tangential_damping_rate;

  const Lanes left = left_by_spring(s, history, dt);
  const ContactForceOf<Lanes> f = law(s, history, dt);

  const auto only = [&](const Lanes& value) { return select(c.touches, value, Lanes{}); };
  const auto only3 = [&](const Lanes3& t) { return Lanes3{only(t.x), only(t.y), only(t.z)}; };
  history.tangential_displacement = only3(history.tangential_displacement);
  history.tangential_stiffness = only(history.tangential_stiffness);
  history.normal_force = only(history.normal_force);
  history.damping_force = only(history.damping_force);
  AnswerLanes a;
  a.force = only3(f.tangential - f.normal * n);
  a.twist = only3(cross(n, f.tangential));
  a.damper = only(f.damping);
  a.damping_work = only(f.damping_work);
  a.friction_work = select(c.touches, f.friction_work, left);
  return a;
}

}  // namespace lahar::dem
