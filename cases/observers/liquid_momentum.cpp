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
  const dem::Particles& p = run_.simulation.solids()->particles();
  double force = 0;
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (p.state[i] != dem::ParticleState::removed) force += p.external_force[i].x();
  }
  impulse_ += run_.simulation.time_step() * force;
}

/// Mean speed of the liquid that goes through the last cells before the domain's end, m/s.
double LiquidMomentum::exit_speed() const {
  const FluidView& fluid = *run_.simulation.fluid();
  const double last = run_.scene.domain.upper.x() - 1.5 * fluid.units().cell_size;
  std::vector<std::pair<double, double>> flux(fluid.wet_block_count());  // of mass and momentum, over density and area
  fluid.for_each_wet_block([&](std::size_t k, std::span<const lbm::WetCell> cells) {
    for (const lbm::WetCell& c : cells) {
      if (c.centre.x() < last || c.velocity.x() <= 0) continue;
      const double flow = c.liquid_volume * c.velocity.x();
      flux[k].first += flow, flux[k].second += flow * c.velocity.x();
    }
  });
  double mass = 0, momentum = 0;
  for (const auto& [m, p] : flux) mass += m, momentum += p;
  return mass > 0 ? momentum / mass : 0;
}

/// Mean speed of what inflows are to bring in the time until now, m/s.
double LiquidMomentum::entry_speed(double interval) const {
  const double now = run_.simulation.time();
  double volume = 0, sum = 0;
  for (const lbm::InflowOptions& inflow : run_.simulation.fluid()->options().inflows) {
    const double part = inflow.discharge.volume_until(now) - inflow.discharge.volume_until(now - interval);
    volume += part, sum += part * inflow.velocity.x();
  }
  return volume > 0 ? sum / volume : 0;
}

void LiquidMomentum::sample(double interval) {
  const FluidView& fluid = *run_.simulation.fluid();
  const double mass = in_domain_.now(), left = fluid.transfers().left, came_in = fluid.transfers().came_in;
  now_ = run_.simulation.liquid_momentum().x();
  if (std::isnan(at_start_)) {
    at_start_ = now_;
  } else {
    given_ += 0.5 * (mass + mass_) * fluid.options().gravity.x() * interval - impulse_;
    if (left > left_) given_ -= (left - left_) * exit_speed();
    if (came_in > came_in_) given_ += (came_in - came_in_) * entry_speed(interval);
  }
  mass_ = mass, left_ = left, came_in_ = came_in, impulse_ = 0;
}

void LiquidMomentum::transfer(Archive& archive) {
  archive.value("at_start", at_start_);
  archive.value("given", given_);
  archive.value("impulse", impulse_);
  archive.value("mass", mass_);
  archive.value("left", left_);
  archive.value("came_in", came_in_);
}

}  // namespace lahar::cases
