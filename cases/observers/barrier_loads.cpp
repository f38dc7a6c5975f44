#include "cases/observers/barrier_loads.h"

#include <string>

namespace lahar::cases {

BarrierLoads::BarrierLoads(const Observed& run) : Observer(run) {
  impulse_.fill(Vec3::Zero()), mean_.fill(Vec3::Zero());
  const auto declare = [this](Load load, const std::string& of, const char* meaning) {
    for (const auto& [axis, a] : {std::pair{"x", 0}, std::pair{"y", 1}, std::pair{"z", 2}})
      column({of + axis + "_N", of + "AXIS_N"}, "N", meaning, [this, load, a = a] { return mean_[load][a]; });
  };
  const bool wet = run.simulation.fluid() != nullptr;
  if (wet) declare(of_water, "barrier_fluid_force_", "force of the liquid on the barrier, mean since the last row");
  declare(of_contacts, "barrier_contact_force_",
          "force of grains and walls on the barrier, mean since the last row of its values after each fluid step; "
          "without a fluid, after each particle step");
  if (wet)
    result("barrier_fluid_impulse_Ns", "Ns", "impulse of the liquid on the barrier, along the flow",
           [this] { return total_[of_water]; });
  result("barrier_contact_impulse_Ns", "Ns", "impulse of grains and walls on the barrier, along the flow",
         [this] { return total_[of_contacts]; });
}

/// Bonds, and beads that touch beads, cancel in the sum over all beads: what is left of it beside gravity and the
/// liquid is of grains and walls.
std::array<Vec3, BarrierLoads::loads> BarrierLoads::now() const {
  const barrier::Net& net = *run_.simulation.net();
  const dem::Solids& solids = *run_.simulation.solids();
  const dem::Particles& p = solids.particles();
  std::array<Vec3, loads> force;
  force.fill(Vec3::Zero());
  for (dem::ParticleId id = net.first_bead; id < net.first_bead + net.beads; ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (p.state[i] == dem::ParticleState::removed) continue;
    force[of_water] += p.external_force[i];
    force[of_contacts] += p.force[i] - p.external_force[i] - p.gravitational_mass[i] * solids.options().gravity;
  }
  for (const dem::Rail& rail : p.rails) force[of_contacts] += rail.taken_up;
  return force;
}

void BarrierLoads::after_step() {
  const auto force = now();
  for (std::size_t load = 0; load < loads; ++load) impulse_[load] += run_.simulation.time_step() * force[load];
}

void BarrierLoads::sample(double interval) {
  for (std::size_t load = 0; load < loads; ++load) {
    mean_[load] = interval > 0 ? Vec3(impulse_[load] / interval) : Vec3(Vec3::Zero());
    total_[load] += impulse_[load].dot(run_.simulation.net()->normal);
    impulse_[load] = Vec3::Zero();
  }
}

void BarrierLoads::transfer(Archive& archive) {
  for (std::size_t load = 0; load < loads; ++load) {
    archive.value("impulse_" + std::to_string(load), impulse_[load]);
    archive.value("total_" + std::to_string(load), total_[load]);
  }
}

}  // namespace lahar::cases
