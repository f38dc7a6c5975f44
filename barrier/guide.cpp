#include "barrier/guide.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace lahar::barrier {

double guide_time_step(const GuideStiffness& guide, double mass) {
  const double zeta = guide.damping_ratio, most = zeta > 0.5 ? 1 / zeta : 4 * zeta;
  return most * std::sqrt(mass / guide.stiffness);
}

void Guides::add(const Wire& cable, const Vec3& point) {
  require(cable.beads > 3 && !cable.closed, "a guide needs a cable of more than three beads");
  guides_.push_back({cable.first_bead, cable.first_bead + cable.beads, point});
}

/// The nearest point of the cable: of all its segments, seen from the guide.
Guides::Place Guides::nearest(const Guide& guide, const dem::Particles& particles) {
  Place best;
  double least = std::numeric_limits<double>::infinity();
  Vec3 start = particles.position[particles.index(guide.first)];
  for (dem::ParticleId bead = guide.first; bead + 1 < guide.last; ++bead) {
    const Vec3 end = particles.position[particles.index(bead + 1)];
    const Vec3 along = end - start, to_guide = guide.point - start;
    const double share = std::clamp(to_guide.dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Vec3 aside = share * along - to_guide;
    if (aside.squaredNorm() < least) {
      least = aside.squaredNorm();
      best = {bead, share, aside, along.normalized()};
    }
    start = end;
  }
  return best;
}

void Guides::apply(dem::Particles& particles) {
  for (const dem::ParticleId bead : loaded_) particles.external_force.set(particles.index(bead), Vec3::Zero());
  loaded_.clear();
  energy_ = 0;
  slipped_out_.reset();
  for (const Guide& g : guides_) {
    const Place at = nearest(g, particles);
    if (at.bead == g.first || at.bead + 2 == g.last) slipped_out_ = g.point;
    const dem::ParticleIndex ends[2] = {particles.index(at.bead), particles.index(at.bead + 1)};
    const double weight[2] = {1 - at.share, at.share};
    const Vec3 velocity = weight[0] * particles.velocity[ends[0]] + weight[1] * particles.velocity[ends[1]];
    const Vec3 moving_aside = velocity - velocity.dot(at.direction) * at.direction;
    const double k = stiffness_.stiffness;
    const double damping = 2 * stiffness_.damping_ratio * std::sqrt(k * particles.mass[ends[0]]);
    const Vec3 force = -k * at.aside - damping * moving_aside;
    for (int end = 0; end < 2; ++end) {
      if (particles.state[ends[end]] != dem::ParticleState::free) continue;
      particles.external_force.set(ends[end], particles.external_force[ends[end]] + weight[end] * force);
      loaded_.push_back(particles.id(ends[end]));
    }
    energy_ += 0.5 * k * at.aside.squaredNorm();
  }
}

}  // namespace lahar::barrier
