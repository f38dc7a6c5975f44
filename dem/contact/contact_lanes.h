#pragma once
// Eight possible contacts side by side: their geometry, and the law on it.
#include "core/simd_math.h"
#include "core/triple.h"
#include "dem/contact/contact_state.h"

namespace lahar::dem {

using Rows3 = TripleOf<Row<double>>;

/// Possible contacts. Side j is a sphere or a wall, which has no spin, radius or inverse mass.
struct EightContacts {
  Rows3 normal{};                  ///< from i to j
  Row<double> overlap{};           ///< m
  Mask<double, kRow> touches{};    ///< lanes that do not touch answer zero
  Rows3 slip{}, slip_end{};        ///< m/s, of i's centre relative to j, at mid-step and at the end of the step
  Rows3 spin{};                    ///< rad/s, sum of both spheres, at mid-step
  Rows3 rim{}, rim_end{};          ///< m/s, sum of radius x spin, at mid-step and at the end of the step
  Row<double> inverse_mass{};      ///< 1/kg, sum of both
  Row<double> damping_rate{};      ///< 1/s, see ContactState
  Row<double> effective_radius{};  ///< m
  Row<double> modulus{}, shear_modulus{}, friction{}, damping_ratio{};  ///< see ContactState

  /// From the vector from centre j to centre i and the sum of radii (m): normal, overlap and whether they touch.
  [[gnu::always_inline]] void set_spheres(const Rows3& between, const Row<double>& radii) {
    const Row<double> square = dot(between, between);
    const Row<double> inverse = inverse_root(square);
    normal = Row<double>(-inverse) * between;
    touches = square < radii * radii;  // not where a particle was removed, whose position is not a number
    // Touching was judged on squares: by rounding the difference may be a hair below zero, and a root is taken of it.
    overlap = max(radii - square * inverse, Row<double>{});
  }
};

/// What they answer; zero where they do not touch, but for what the end of a contact leaves to friction.
struct EightAnswers {
  Rows3 force, twist;                       ///< N, on i; the torque on either sphere is its arm x twist
  Row<double> damper;                       ///< N s/m, of the normal damper
  Row<double> damping_work, friction_work;  ///< J
};

/// What goes to friction when a contact ends, J: what its spring still holds, and what its last force did in the step
/// that parted the two. Nothing of the latter where a particle was removed, whose motion is not a number.
[[gnu::always_inline]] inline Row<double> left_by_spring(const ContactStateOf<Row<double>>& s,
                                                         const ContactHistoryOf<Row<double>>& h, double dt) {
  const Row<double> half = 0.5 * h.tangential_stiffness;
  const Row<double> held = half * dot(h.tangential_displacement, h.tangential_displacement);
  const Row<double> last = half * dt * dot(h.tangential_displacement, s.tangential_velocity);
  return max(held + select(last == last, last, Row<double>{}), Row<double>{});
}

/// Evaluates contacts and advances what they remember by `dt` (s).
template <ContactLaw L>
[[gnu::always_inline]] inline EightAnswers evaluate(const EightContacts& c, ContactHistoryOf<Row<double>>& history,
                                                    const L& law, double dt) {
  const Rows3& n = c.normal;
  const Row<double> half = 0.5 * c.overlap;  // the arms are the radii less half the overlap
  const Rows3 turning = cross(c.rim - half * c.spin, n);
  const Rows3 turning_end = cross(c.rim_end - half * c.spin, n);  // what half an overlap takes off the arms is small

  ContactStateOf<Row<double>> s;
  s.overlap = c.overlap;
  s.closing_speed = dot(c.slip_end, n);
  s.normal_ij = n;
  s.tangential_velocity = normal_part(c.slip, n) + turning;
  s.tangential_velocity_end = (c.slip_end - s.closing_speed * n) + turning_end;
  s.twist_rate = 0.5 * dot(c.spin, n);
  s.effective_radius = c.effective_radius;
  s.effective_mass = select(c.inverse_mass > 0, 1.0 / c.inverse_mass, Row<double>{});
  s.effective_modulus = c.modulus;
  s.effective_shear_modulus = c.shear_modulus;
  s.friction = c.friction;
  s.damping_ratio = c.damping_ratio;
  s.damping_rate = c.damping_rate;

  const Row<double> left = left_by_spring(s, history, dt);
  const ContactForceOf<Row<double>> f = law(s, history, dt);

  const auto only = [&](const Row<double>& value) { return select(c.touches, value, Row<double>{}); };
  const auto only3 = [&](const Rows3& t) { return Rows3{only(t.x), only(t.y), only(t.z)}; };
  history.tangential_displacement = only3(history.tangential_displacement);
  history.tangential_stiffness = only(history.tangential_stiffness);
  history.normal_force = only(history.normal_force);
  history.damping_force = only(history.damping_force);
  EightAnswers a;
  a.force = only3(f.tangential - f.normal * n);
  a.twist = only3(cross(n, f.tangential));
  a.damper = only(f.damping);
  a.damping_work = only(f.damping_work);
  a.friction_work = select(c.touches, f.friction_work, left);
  return a;
}

}  // namespace lahar::dem
