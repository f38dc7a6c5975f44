#include "cases/observers/barrier_loads.h"

#include <string>

namespace lahar::cases {

namespace {

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

}  // namespace

BarrierLoads::BarrierLoads(const Observed& run) : Observer(run) {
  impulse_.fill(Vec3::Zero()), mean_.fill(Vec3::Zero());
  const std::array<std::pair<const char*, const char*>, loads> names{
      {{"barrier_fluid_force_", "force of the liquid on the barrier, mean since the last row"},
       {"barrier_contact_force_",
        "force of grains and walls on the barrier, mean since the last row of its values after each fluid step"},
       {"grains_fluid_force_", "force of the liquid on all grains, mean since the last row"}}};
  for (std::size_t load = 0; load < loads; ++load)
    for (std::size_t a = 0; a < kAxes.size(); ++a)
      column({std::string(names[load].first) + kAxes[a] + "_N", std::string(names[load].first) + "AXIS_N"}, "N",
             names[load].second, [this, load, a] { return mean_[load][static_cast<int>(a)]; });
  result("barrier_fluid_impulse_Ns", "Ns", "impulse of the liquid on the barrier, along the flow",
         [this] { return total_[water_on_net]; });
  result("barrier_contact_impulse_Ns", "Ns", "impulse of grains and walls on the barrier, along the flow",
         [this] { return total_[contacts_on_net]; });
}

/// Bonds, and beads that touch beads, cancel in the sum over all beads: what is left of it beside gravity and the
/// liquid is of grains and walls.
std::array<Vec3, BarrierLoads::loads> BarrierLoads::now() const {
  const barrier::Net& net = *run_.simulation.net();
  const dem::Solids& solids = *run_.simulation.solids();
  const dem::Particles& p = solids.particles();
  std::array<Vec3, loads> force;
  force.fill(Vec3::Zero());
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (p.state[i] == dem::ParticleState::removed) continue;
    const bool of_net = id >= net.first_bead && id < net.first_bead + net.beads;
    if (of_net) {
      force[water_on_net] += p.external_force[i];
      force[contacts_on_net] += p.force[i] - p.external_force[i] - p.gravitational_mass[i] * solids.options().gravity;
    } else if (p.kind[i] == dem::ParticleKind::grain) {
      force[water_on_grains] += p.external_force[i];
    }
  }
  for (const dem::Rail& rail : p.rails) force[contacts_on_net] += rail.taken_up;
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
