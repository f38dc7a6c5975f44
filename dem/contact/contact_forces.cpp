#include "dem/contact/contact_forces.h"

#include <algorithm>

#include "core/check.h"
#include "core/parallel.h"

namespace lahar::dem {

namespace {

/// Gravity and external forces of the particles of this rate.
void set_body_forces(Particles& p, const Vec3& acceleration, const RateShare& share, std::size_t first,
                     std::size_t last) {
  const auto set = [&](std::vector<double>& force, const std::vector<double>& external, double gravity) {
    double* f = force.data();
    const double *e = external.data(), *mass = p.gravitational_mass.data();
    const ParticleState* state = p.state.data();
    for (std::size_t i = first; i < last; ++i)
      f[i] = (state[i] == ParticleState::removed ? 0.0 : mass[i]) * gravity + e[i];
  };
  set(p.force.x, p.external_force.x, acceleration.x());
  set(p.force.y, p.external_force.y, acceleration.y());
  set(p.force.z, p.external_force.z, acceleration.z());
  const auto copy = [&](const std::vector<double>& from, std::vector<double>& to) {
    std::copy(from.data() + first, from.data() + last, to.data() + first);
  };
  copy(p.external_torque.x, p.torque.x);
  copy(p.external_torque.y, p.torque.y);
  copy(p.external_torque.z, p.torque.z);
  for (std::size_t i = first; share.rate != Rate::all && i < last; ++i) {
    if (share.single(i)) continue;
    p.force.x[i] = p.force.y[i] = p.force.z[i] = 0;
    p.torque.x[i] = p.torque.y[i] = p.torque.z[i] = 0;
  }
}

}  // namespace

void ContactForces::compute(Particles& particles, ContactDetection& contacts, const Walls& walls, const Vec3& gravity,
                            double dt, const RateShare& share, const MeanMotion* mean) {
  const std::size_t n = particles.size();
  require(contacts.pairs().offset.size() == n + 1, "contact lists do not belong to these particles");
  if (noted_refresh_ != contacts.refreshes()) {
    pairs_.note_slots(particles, contacts, materials_);
    walls_.resize(contacts.wall_contacts().size(), particles.numbering);
    noted_refresh_ = contacts.refreshes();
  }
  damping_.resize(n);
  pairs_.pack(particles, contacts, damping_, dt, mean);
  tallies_.assign((n + kContactChunk - 1) / kContactChunk, {});
  parallel_for(0, tallies_.size(), 1, [&](std::size_t chunk) {
    ContactTally tally;
    pairs_.evaluate(law_, contacts, materials_, dt, chunk, tally);
    walls_.evaluate(law_, particles, damping_, contacts, walls, materials_, dt, mean, chunk, tally);
    tallies_[chunk] = tally;
  });
  parallel_for(0, tallies_.size(), 1, [&](std::size_t chunk) {
    ContactTally tally = tallies_[chunk];
    const std::size_t first = chunk * kContactChunk, last = std::min(n, first + kContactChunk);
    set_body_forces(particles, gravity, share, first, last);
    std::fill(damping_.data() + first, damping_.data() + last, 0.0);
    walls_.add_to(particles, damping_, contacts, chunk);
    pairs_.add_partners(particles, damping_, contacts, chunk, tally);
    tallies_[chunk] = tally;
  });
  if (!particles.numbering.by_id()) tally_by_id(particles, contacts, dt);
  sum_tallies();
}

/// The tallies of chunks by index are not those of chunks by id: sums them up again in the order of ids.
void ContactForces::tally_by_id(const Particles& particles, const ContactDetection& contacts, double dt) {
  const Numbering& numbering = particles.numbering;
  parallel_for(0, tallies_.size(), 1, [&](std::size_t chunk) {
    ContactTally tally;
    pairs_.tally_damping(numbering, contacts, chunk, tally);
    walls_.tally_by_id(numbering, contacts, dt, chunk, tally);
    pairs_.tally_friction(chunk, tally);
    tallies_[chunk] = tally;
  });
}

void ContactForces::sum_tallies() {
  energy_.elastic_rolling = energy_.damping_of_step = energy_.wall_work_of_step = 0;
  for (const ContactTally& t : tallies_) {
    energy_.elastic_rolling += t.elastic_rolling;
    energy_.damping += t.damping;
    energy_.friction += t.friction;
    energy_.rolling += t.rolling;
    energy_.wall_work += t.wall_work;
    energy_.damping_of_step += t.damping;
    energy_.wall_work_of_step += t.wall_work;
  }
}

void ContactForces::transfer(Archive& archive) {
  energy_.transfer(archive);
  archive.list("damping_of_particles", damping_);
  if (!archive.loading()) return;
  noted_refresh_ = -1;
  walls_.clear();
}

}  // namespace lahar::dem
