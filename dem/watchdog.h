#pragma once
// Stops a run whose numbers went wrong, and says which particle, where, when and why.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "core/check.h"
#include "core/number_text.h"
#include "dem/bonds/bonds.h"
#include "dem/contact/worst_overlap.h"
#include "dem/particles.h"
#include "dem/time_step.h"

namespace lahar::dem {

struct WatchdogOptions {
  double speed_limit = std::numeric_limits<double>::infinity();  ///< m/s, of a centre, and of a surface by its spin
  double overlap_limit = 0.5;                                    ///< of the smaller radius in a contact
  int interval = 50;                                             ///< steps between checks, >= 1
};

namespace detail {

/// "bead 17 at (0.1, 0.2, 0.3)"
inline std::string particle_name(const Particles& p, std::size_t i) {
  const char* kind = p.kind[i] == ParticleKind::bead ? "bead " : "grain ";
  return kind + std::to_string(p.id(i)) + " at (" + number_text(p.position.x[i]) + ", " + number_text(p.position.y[i]) +
         ", " + number_text(p.position.z[i]) + ")";
}

/// 0 unless x is infinite or not a number; a sum of these over an array is a branch-free test.
inline double defect(double x) { return x - x; }

}  // namespace detail

/// Throws NumericalFailure for the first particle by id whose position, velocity or spin is not finite or which is
/// faster than the limit: its centre, or its surface by its spin alone.
inline void check_motion(const Particles& p, const WatchdogOptions& options, std::int64_t step) {
  const std::size_t n = p.size();
  const double limit2 = options.speed_limit * options.speed_limit;
  int bad = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double speed2 =
        p.velocity.x[i] * p.velocity.x[i] + p.velocity.y[i] * p.velocity.y[i] + p.velocity.z[i] * p.velocity.z[i];
    const double spin2 = p.angular_velocity.x[i] * p.angular_velocity.x[i] +
                         p.angular_velocity.y[i] * p.angular_velocity.y[i] +
                         p.angular_velocity.z[i] * p.angular_velocity.z[i];
    const double defect = detail::defect(p.position.x[i]) + detail::defect(p.position.y[i]) +
                          detail::defect(p.position.z[i]) + detail::defect(p.angular_velocity.x[i]) +
                          detail::defect(p.angular_velocity.y[i]) + detail::defect(p.angular_velocity.z[i]) +
                          detail::defect(speed2);
    bad |= !(defect == 0) | !(speed2 <= limit2) | !(spin2 * p.radius[i] * p.radius[i] <= limit2);
  }
  if (bad == 0) return;
  for (std::size_t id = 0; id < n; ++id) {
    const ParticleIndex i = p.index(id);
    const std::string name = detail::particle_name(p, i);
    const double speed = p.velocity[i].norm();
    if (!p.position[i].allFinite()) throw NumericalFailure(name, step, "position is not finite");
    if (!std::isfinite(speed)) throw NumericalFailure(name, step, "velocity is not finite");
    if (!p.angular_velocity[i].allFinite()) throw NumericalFailure(name, step, "angular velocity is not finite");
    if (speed > options.speed_limit)
      throw NumericalFailure(
          name, step,
          "speed " + number_text(speed) + " m/s exceeds the limit of " + number_text(options.speed_limit) + " m/s");
    const double spin = p.angular_velocity[i].norm();
    if (const double surface = spin * p.radius[i]; surface > options.speed_limit)
      throw NumericalFailure(name, step,
                             "spin of " + number_text(spin) + " rad/s moves its surface at " + number_text(surface) +
                                 " m/s, which exceeds the limit of " + number_text(options.speed_limit) + " m/s");
  }
}

/// Throws NumericalFailure if the deepest contact is beyond the limit.
inline void check_overlap(const Particles& p, const WorstOverlap& worst, const WatchdogOptions& options,
                          std::int64_t step) {
  if (worst.ratio <= options.overlap_limit) return;
  const std::string partner =
      worst.with_wall ? "wall " + std::to_string(worst.partner) : detail::particle_name(p, p.index(worst.partner));
  throw NumericalFailure(detail::particle_name(p, p.index(worst.particle)), step,
                         "overlap with " + partner + " is " + number_text(worst.ratio) +
                             " of the smaller radius, limit " + number_text(options.overlap_limit));
}

/// Throws NumericalFailure if the time step is beyond the limit of the bonds as long as they are now.
inline void check_bonds(const Bonds& bonds, const Particles& p, double time_step, std::int64_t step) {
  const double limit = bond_time_step(bonds, p);
  if (time_step <= limit) return;
  std::size_t longest = 0;
  while (!bonds.intact[longest]) ++longest;  // one is whole: the limit is of those that are
  for (std::size_t b = longest; b < bonds.size(); ++b)
    if (bonds.intact[b] && bonds.elongation[b] > bonds.elongation[longest]) longest = b;
  throw NumericalFailure(detail::particle_name(p, bonds.i[longest]), step,
                         "bonds that are drawn out, by " + number_text(bonds.elongation[longest]) +
                             " m here, allow time steps of " + number_text(limit) + " s; this is " +
                             number_text(time_step) + " s");
}

}  // namespace lahar::dem
