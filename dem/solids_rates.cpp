// Two rates: impulses of the slow contacts around each long step (reversible multiple-time-step integrator of
// Tuckerman, Berne & Martyna 1992, J. Chem. Phys. 97:1990, with contacts among grains and with walls as the slow
// forces).
//
// A long step of m sub-steps h: half a kick of m h by the slow forces; m sub-steps (half kick, drift, half kick) under
// what acts at beads; half a kick by the slow forces at the new positions. Every force acts on both sides of a pair
// with the same impulse, so momentum is exact; without friction and damping the map is symplectic.
#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "dem/integrator.h"
#include "dem/solids.h"

namespace lahar::dem {

/// Slow are grains without bonds. A scene in which nothing else is there has one rate.
void Solids::find_slow() {
  slow_.clear();
  slow_particles_.clear();
  if (options_.long_step == 1) return;
  const std::size_t n = particles_.size();
  std::vector<std::uint8_t> slow(n, 0);
  for (std::size_t i = 0; i < n; ++i) slow[i] = particles_.kind[i] == ParticleKind::grain ? 1 : 0;
  for (std::size_t b = 0; b < bonds_.size(); ++b) slow[bonds_.i[b]] = slow[bonds_.j[b]] = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (slow[i] != 0) slow_particles_.push_back(static_cast<ParticleIndex>(i));
  if (slow_particles_.empty() || slow_particles_.size() == n) return slow_particles_.clear();
  slow_ = std::move(slow);
  for (Vec3Field* f : {&slow_force_, &slow_torque_, &mean_.velocity, &mean_.spin}) f->resize(n);
}

/// `final`: the last one under the present external forces.
void Solids::long_step(int substeps, std::span<LiquidDrag> drags, bool final) {
  const double dt = slow_step_ = substeps * options_.time_step;
  kick_slow(0.5 * dt);
  for (int n = 0; n < substeps; ++n) {
    const bool last = n + 1 == substeps;
    substep(n == 0, last, drags, last && final ? 0.5 * options_.time_step : options_.time_step);
  }
  const double share = 1.0 / substeps;
  for (const ParticleIndex i : slow_particles_) {
    mean_.velocity.set(i, share * mean_.velocity[i]);
    mean_.spin.set(i, share * mean_.spin[i]);
  }
  detect_slow();
  evaluate_slow(dt, &mean_);
  add_wall_impulses(slow_forces_, slow_contacts_, dt);
  kick_slow(0.5 * dt);
}

void Solids::kick_slow(double dt) {
  const ScopedTimer timer(*section_integrate_);
  std::swap(particles_.force, slow_force_);
  std::swap(particles_.torque, slow_torque_);
  kick(particles_, dt);
  std::swap(particles_.force, slow_force_);
  std::swap(particles_.torque, slow_torque_);
}

/// Slow particles that touch beads change their velocities in sub-steps; what their slow contacts slide follows from
/// the mean.
void Solids::add_to_mean(bool first) {
  const Particles& p = particles_;
  parallel_for_even_chunks(slow_particles_.size(), 2048, [&](std::size_t a, std::size_t b) {
    for (std::size_t k = a; k < b; ++k) {
      const ParticleIndex i = slow_particles_[k];
      const auto add = [&](std::vector<double>& sum, const std::vector<double>& now) {
        sum[i] = first ? now[i] : sum[i] + now[i];
      };
      add(mean_.velocity.x, p.velocity.x), add(mean_.velocity.y, p.velocity.y), add(mean_.velocity.z, p.velocity.z);
      add(mean_.spin.x, p.angular_velocity.x), add(mean_.spin.y, p.angular_velocity.y);
      add(mean_.spin.z, p.angular_velocity.z);
    }
  });
}

void Solids::detect_slow() {
  const ScopedTimer timer(*section_detect_);
  if (!slow_contacts_.outdated(particles_)) return;
  check_motion(particles_, options_.watchdog, step_count_);  // lists need finite positions
  slow_forces_.book_lost(slow_contacts_.neighbours_hold(particles_)
                             ? slow_contacts_.refresh(particles_, share(Rate::slow))
                             : slow_contacts_.rebuild(particles_, walls_, bonded_, share(Rate::slow)));
}

/// What grains feel of each other, of walls, of gravity and from outside.
void Solids::evaluate_slow(double dt, const MeanMotion* mean) {
  const ScopedTimer timer(*section_contact_);
  std::swap(particles_.force, slow_force_);
  std::swap(particles_.torque, slow_torque_);
  slow_forces_.compute(particles_, slow_contacts_, walls_, options_.gravity, dt, share(Rate::slow), mean);
  std::swap(particles_.force, slow_force_);
  std::swap(particles_.torque, slow_torque_);
}

WorstOverlap Solids::worst_overlap() const {
  WorstOverlap worst = dem::worst_overlap(particles_, contacts_, walls_);
  const auto consider = [&worst](const WorstOverlap& other) {
    if (other.ratio > worst.ratio) worst = other;
  };
  if (two_rates()) consider(dem::worst_overlap(particles_, slow_contacts_, walls_));
  if (wires_) consider(wires_->worst_overlap());
  return worst;
}

Vec3 Solids::force_on_wall(std::uint32_t wall) const {
  return contact_forces_.force_on_wall(particles_, contacts_, wall) +
         slow_forces_.force_on_wall(particles_, slow_contacts_, wall);
}

Vec3 Solids::moment_on_wall(std::uint32_t wall) const {
  return contact_forces_.moment_on_wall(particles_, contacts_, walls_, wall) +
         slow_forces_.moment_on_wall(particles_, slow_contacts_, walls_, wall);
}

void Solids::measure_walls(const std::vector<std::uint32_t>& walls) {
  for (const std::uint32_t wall : walls) wall_impulses_.try_emplace(wall);
}

WallImpulse Solids::take_impulse_on(std::uint32_t wall) {
  const auto found = wall_impulses_.find(wall);
  return found == wall_impulses_.end() ? WallImpulse{} : std::exchange(found->second, {});
}

void Solids::add_wall_impulses(const ContactForces& forces, const ContactDetection& contacts, double dt) {
  for (auto& [wall, sum] : wall_impulses_) {
    sum.linear += dt * forces.force_on_wall(particles_, contacts, wall);
    sum.angular += dt * forces.moment_on_wall(particles_, contacts, walls_, wall);
  }
}

}  // namespace lahar::dem
