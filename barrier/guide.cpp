#include "barrier/guide.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace lahar::barrier {

void Guides::add(const Wire& cable, const Vec3& point, const Vec3& axis, double spacing) {
  require(spacing > 0 && std::abs(axis.norm() - 1) < 1e-9, "a guide needs a unit axis and a spacing of beads");
  guides_.push_back({cable.first_bead, cable.first_bead + cable.beads, point, axis, spacing});
}

void Guides::apply(dem::Particles& particles) {
  for (const dem::ParticleIndex i : held_) particles.external_force.set(i, Vec3::Zero());
  held_.clear();
  energy_ = largest_force_ = 0;
  loosest_ = {.grip = std::numeric_limits<double>::infinity()};
  for (const Guide& g : guides_) {
    Vec3 sum = Vec3::Zero();
    double grip = 0;
    for (dem::ParticleIndex i = g.first; i < g.last; ++i) {
      const Vec3 from = particles.position[i] - g.point;
      const double along = from.dot(g.axis), weight = 1 - std::abs(along) / g.spacing;
      if (weight <= 0) continue;
      grip += weight;
      if (particles.state[i] != dem::ParticleState::free) continue;
      const Vec3 aside = from - along * g.axis, velocity = particles.velocity[i];
      const Vec3 moving_aside = velocity - velocity.dot(g.axis) * g.axis;
      const double k = stiffness_.stiffness, damping = 2 * stiffness_.damping_ratio * std::sqrt(k * particles.mass[i]);
      const Vec3 across = -weight * (k * aside + damping * moving_aside);
      // The weight changes along the axis, and the energy of the spring with it.
      const double slope = (along > 0 ? -1.0 : 1.0) / g.spacing;
      particles.external_force.set(
          i, particles.external_force[i] + across - 0.5 * k * aside.squaredNorm() * slope * g.axis);
      held_.push_back(i);
      energy_ += 0.5 * weight * k * aside.squaredNorm();
      sum += across;
    }
    largest_force_ = std::max(largest_force_, sum.norm());
    if (grip < loosest_.grip) loosest_ = {grip, g.point};
  }
}

}  // namespace lahar::barrier
