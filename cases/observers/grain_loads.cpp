#include "cases/observers/grain_loads.h"

#include <string>

namespace lahar::cases {

GrainLoads::GrainLoads(const Observed& run) : Observer(run) {
  const std::string of = "grains_fluid_force_";
  for (const auto& [axis, a] : {std::pair{"x", 0}, std::pair{"y", 1}, std::pair{"z", 2}})
    column({of + axis + "_N", of + "AXIS_N"}, "N", "force of the liquid on all grains, mean since the last row",
           [this, a = a] { return mean_[a]; });
}

void GrainLoads::after_step() {
  const dem::Particles& p = run_.simulation.solids()->particles();
  Vec3 force = Vec3::Zero();
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (p.kind[i] == dem::ParticleKind::grain && p.state[i] != dem::ParticleState::removed)
      force += p.external_force[i];
  }
  impulse_ += run_.simulation.time_step() * force;
}

void GrainLoads::sample(double interval) {
  mean_ = interval > 0 ? Vec3(impulse_ / interval) : Vec3(Vec3::Zero());
  impulse_ = Vec3::Zero();
}

void GrainLoads::transfer(Archive& archive) { archive.value("impulse", impulse_); }

}  // namespace lahar::cases
