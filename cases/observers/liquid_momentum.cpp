#include "cases/observers/liquid_momentum.h"

#include <cmath>

namespace lahar::cases {

LiquidMomentum::LiquidMomentum(const Observed& run, const ObserverList& before)
    : Observer(run), in_domain_(*before.find<LiquidMass>()) {
  column("fluid_momentum_x_Ns", "Ns", "momentum of the liquid along x", [this] { return now_; });
  column("fluid_momentum_gap_x_Ns", "Ns",
         "what that has grown by since the start, less what weight gave and inflows brought, plus what bodies got and "
         "what left took along: of the walls, and made or lost at the surface",
         [this] { return now_ - at_start_ - given_; });
}

void LiquidMomentum::after_step() {
  const FluidView& fluid = *run_.simulation.fluid();
  const double time_step = run_.simulation.time_step();
  const LiquidTransfers so_far = fluid.transfers();
  const double leaves = so_far.left - left_, comes_in = so_far.came_in - came_in_;
  if (leaves > 0)
    if (const auto velocity = fluid.leaving_velocity()) exit_speed_ = velocity->x();
  if (comes_in > 0) entry_speed_ = entry_speed(time_step);
  const double mean_mass = mass_ + 0.5 * (comes_in - leaves);
  given_ += (mean_mass * fluid.options().gravity.x() - force_on_bodies()) * time_step;
  given_ += comes_in * entry_speed_ - leaves * exit_speed_;
  mass_ += comes_in - leaves, left_ = so_far.left, came_in_ = so_far.came_in;
}

/// Of the liquid on grains and barrier, along x, N.
double LiquidMomentum::force_on_bodies() const {
  const dem::Particles& p = run_.simulation.solids()->particles();
  double force = 0;
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (p.state[i] != dem::ParticleState::removed) force += p.external_force[i].x();
  }
  return force;
}

/// Mean speed of what inflows are to bring in the time until now, m/s; where that is nothing, what waited comes, as
/// fast as what came before.
double LiquidMomentum::entry_speed(double interval) const {
  const double now = run_.simulation.time();
  double volume = 0, sum = 0;
  for (const lbm::InflowOptions& inflow : run_.simulation.fluid()->options().inflows) {
    const double part = inflow.discharge.volume_until(now) - inflow.discharge.volume_until(now - interval);
    volume += part, sum += part * inflow.velocity.x();
  }
  return volume > 0 ? sum / volume : entry_speed_;
}

void LiquidMomentum::sample(double) {
  now_ = run_.simulation.liquid_momentum().x();
  mass_ = in_domain_.now();
  if (std::isnan(at_start_)) at_start_ = now_, given_ = 0;
}

void LiquidMomentum::transfer(Archive& archive) {
  archive.value("at_start", at_start_);
  archive.value("given", given_);
  archive.value("exit_speed", exit_speed_);
  archive.value("entry_speed", entry_speed_);
  archive.value("mass", mass_);
  archive.value("left", left_);
  archive.value("came_in", came_in_);
}

}  // namespace lahar::cases
