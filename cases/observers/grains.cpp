#include "cases/observers/grains.h"

#include <algorithm>

namespace lahar::cases {

Grains::Grains(const Observed& run) : Observer(run), way_(run.simulation.solids()->particles().size()) {
  column("grains_kinetic_J", "J", "translation and rotation of the grains", [this] { return kinetic_; });
  column("grains_potential_J", "J", "potential energy of the grains about the datum", [this] { return potential_; });
  column("grains_front_x_m", "m", "foremost point of the grains; the domain's lower x where there are none",
         [this] { return front_; });
  column("grains_passed_kg", "kg", "mass of grains that came past the outflow section, or are gone",
         [this] { return passed_; });
  if (run.section) {
    result("e_out_grains_kinetic_kJ", "kJ", "kinetic energy of grains that passed the outflow section, or are gone",
           [this] { return kinetic_out_ / 1000; });
    result("e_out_grains_potential_kJ", "kJ", "potential energy of grains that passed the outflow section, or are gone",
           [this] { return (energy_out_ - kinetic_out_) / 1000; });
    event("particle_arrival_s", "s", "first row with `grains_front_x_m` at the measured section or beyond",
          [this] { return front_ >= *run_.section ? run_.simulation.time() : kUnknown; });
  }
}

namespace {

/// J: what a grain has of translation and rotation.
double kinetic_energy(const dem::Particles& p, std::size_t i) {
  return 0.5 * p.mass[i] * p.velocity[i].squaredNorm() + 0.5 * p.inertia[i] * p.angular_velocity[i].squaredNorm();
}

}  // namespace

bool has_left(const scene::Domain& domain, const dem::Particles& p, std::size_t i) {
  const Vec3 x = p.position[i];
  const double r = p.radius[i];
  return (x.array() < domain.lower.array() - r).any() || x.x() > domain.upper.x() + r || x.y() > domain.upper.y() + r;
}

void Grains::note_passages() {
  const auto& p = run_.simulation.solids()->particles();
  const double g = run_.scene.gravity.magnitude;
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    if (way_[id] != Way::upstream) continue;
    const dem::ParticleIndex i = p.index(id);
    if (!is_loose_grain(p, i)) continue;
    const bool gone = p.state[i] == dem::ParticleState::removed || has_left(run_.scene.domain, p, i);
    if (!gone && !(run_.section && p.position.x[i] > *run_.section + run_.scene.measure.outflow_distance)) continue;
    way_[id] = has_begun_ ? Way::passed : Way::beyond_at_start;
    if (!has_begun_) continue;
    const double move = kinetic_energy(p, i);
    energy_out_ += move + p.mass[i] * g * run_.height(p.position[i]), kinetic_out_ += move;
  }
}

void Grains::sample(double) {
  note_passages();
  const auto& p = run_.simulation.solids()->particles();
  const double g = run_.scene.gravity.magnitude;
  kinetic_ = potential_ = passed_ = 0;
  front_ = run_.scene.domain.lower.x();
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (!is_loose_grain(p, i)) continue;
    if (p.state[i] != dem::ParticleState::removed) {
      kinetic_ += kinetic_energy(p, i), potential_ += p.mass[i] * g * run_.height(p.position[i]);
      front_ = std::max(front_, p.position.x[i] + p.radius[i]);
    }
    if (way_[id] == Way::passed) passed_ += p.mass[i];
  }
  has_begun_ = true;
}

void Grains::transfer(Archive& archive) {
  archive.list_of("way", way_, way_.size());
  archive.value("has_begun", has_begun_);
  archive.value("energy_out", energy_out_);
  archive.value("kinetic_out", kinetic_out_);
}

}  // namespace lahar::cases
