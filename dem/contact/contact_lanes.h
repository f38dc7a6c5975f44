#pragma once
// Eight possible contacts side by side: their geometry, and the law on it.
#include "dem/contact/contact_state.h"
#include "dem/fast_math.h"
#include "dem/lanes.h"
#include "dem/triple.h"

namespace lahar::dem {

using Lines3 = TripleOf<Line>;

/// Possible contacts. Side j is a sphere or a wall, which has no spin, radius or inverse mass.
struct EightContacts {
  Lines3 normal{};            ///< from i to j
  Line overlap{};             ///< m
  LineMask touches{};         ///< lanes that do not touch answer zero
  Lines3 slip{}, slip_end{};  ///< m/s, of i's centre relative to j, at mid-step and at the end of the step
  Lines3 spin{}, spin_end{};  ///< rad/s, sum of both spheres
  Lines3 rim{}, rim_end{};    ///< m/s, sum of radius x spin
  Line inverse_mass{};        ///< 1/kg, sum of both
  Line effective_radius{};    ///< m
  Line modulus{}, shear_modulus{}, friction{}, damping_ratio{};  ///< see ContactState

  /// From the vector from centre j to centre i and the sum of radii (m): normal, overlap and whether they touch.
  [[gnu::always_inline]] void set_spheres(const Lines3& between, const Line& radii) {
    const Line square = dot(between, between);
    const Line inverse = inverse_root(square);
    normal = Line(-inverse) * between;
    touches = square < radii * radii;  // not where a particle was removed, whose position is not a number
    // Touching was judged on squares: by rounding the difference may be a hair below zero, and a root is taken of it.
    overlap = larger(radii - square * inverse, Line{});
  }
};

/// What they answer; zero where they do not touch, but for what the end of a contact leaves to friction.
struct EightAnswers {
  Lines3 force, twist;  ///< N, on i; the torque on either sphere is its arm x twist
  Line elastic_normal, elastic_tangential, damping, friction;  ///< J
};

/// What goes to friction when a contact ends, J: what its spring still holds, and what its last force did in the step
/// that parted the two. Nothing of the latter where a particle was removed, whose motion is not a number.
[[gnu::always_inline]] inline Line left_by_spring(const ContactStateOf<Line>& s, const ContactHistoryOf<Line>& h,
                                                  double dt) {
  const Line half = 0.5 * h.tangential_stiffness;
  const Line held = half * dot(h.tangential_displacement, h.tangential_displacement);
  const Line last = half * dt * dot(h.tangential_displacement, s.tangential_velocity);
  return larger(held + choose(last == last, last, Line{}), Line{});
}

/// Evaluates contacts and advances what they remember by `dt` (s).
template <ContactLaw L>
[[gnu::always_inline]] inline EightAnswers evaluate(const EightContacts& c, ContactHistoryOf<Line>& history,
                                                    const L& law, double dt) {
  const Lines3& n = c.normal;
  const Line half = 0.5 * c.overlap;  // the arms are the radii less half the overlap
  const Lines3 turning = cross(c.rim - half * c.spin, n);
  const Lines3 turning_end = cross(c.rim_end - half * c.spin_end, n);

  ContactStateOf<Line> s;
  s.overlap = c.overlap;
  s.closing_speed = dot(c.slip_end, n);
  s.normal_ij = n;
  s.tangential_velocity = normal_part(c.slip, n) + turning;
  s.tangential_velocity_end = (c.slip_end - s.closing_speed * n) + turning_end;
  s.twist_rate = 0.5 * dot(c.spin, n);
  s.effective_radius = c.effective_radius;
  s.effective_mass = choose(c.inverse_mass > 0, 1.0 / c.inverse_mass, Line{});
  s.effective_modulus = c.modulus;
  s.effective_shear_modulus = c.shear_modulus;
  s.friction = c.friction;
  s.damping_ratio = c.damping_ratio;

  const Line left = left_by_spring(s, history, dt);
  const ContactForceOf<Line> f = law(s, history, dt);

  const auto only = [&](const Line& value) { return choose(c.touches, value, Line{}); };
  const auto only3 = [&](const Lines3& t) { return Lines3{only(t.x), only(t.y), only(t.z)}; };
  history.tangential_displacement = only3(history.tangential_displacement);
  history.tangential_stiffness = only(history.tangential_stiffness);
  history.normal_force = only(history.normal_force);
  EightAnswers a;
  a.force = only3(f.tangential - f.normal * n);
  a.twist = only3(cross(n, f.tangential));
  a.elastic_normal = only(f.elastic_normal);
  a.elastic_tangential = only(f.elastic_tangential);
  a.damping = only(f.damping_work);
  a.friction = choose(c.touches, f.friction_work, left);
  return a;
}

}  // namespace lahar::dem
