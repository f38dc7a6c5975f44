#include "cases/observers/flow_energy.h"

#include <cmath>

namespace lahar::cases {

FlowEnergy::FlowEnergy(const Observed& run, const ObserverList& before)
    : Observer(run), flow_(*before.find<Flow>()), outflow_(*before.find<Outflow>()), grains_(before.find<Grains>()) {
  event("e_in_kJ", "kJ",
        "kinetic and potential energy of liquid and grains at the first row with the front within "
        "`measure.inflow_distance_m` upstream of the measured section",
        [this] { return arrival_.energy; });
  event("froude_deepest_section", "1",
        "speed of the deepest section over sqrt(g depth), g across the bed, at the row of `e_in_kJ`",
        [this] { return arrival_.froude_deepest; });
  event("depth_at_inflow_m", "m", "depth of the deepest section, mean over the wet width, at the row of `e_in_kJ`",
        [this] { return arrival_.depth; });
  event("froude_mean_speed", "1",
        "mean speed of all liquid over sqrt(g depth), g across the bed, at the row of `e_in_kJ`",
        [this] { return arrival_.froude_mean; });
  if (grains_)
    result(
        "e_out_kJ", "kJ",
        "energy of liquid and grains that has passed `measure.outflow_distance_m` beyond the measured section, and of "
        "grains that are gone; absent without a fluid, or without grains and barrier, or where its liquid's energy is",
        [this] { return (outflow_.energy().sum() + grains_->energy_out()) / 1000; })
        .unknown_at_times();
}

void FlowEnergy::sample(double) {
  arrival_ = {};
  if (has_arrived_ || flow_.now().front < *run_.section - run_.scene.measure.inflow_distance) return;
  has_arrived_ = true;
  take_arrival();
}

void FlowEnergy::take_arrival() {
  const FlowFigures& f = flow_.now();
  arrival_.energy = (f.kinetic + f.potential + (grains_ ? grains_->energy() : 0.0)) / 1000;
  const double g = -run_.scene.gravity.vector().z();
  if (f.deepest <= 0 || g <= 0) return;
  arrival_.froude_deepest = f.deepest_speed / std::sqrt(g * f.deepest);
  arrival_.depth = f.deepest;
  const double mass = run_.simulation.fluid()->liquid_mass();
  if (mass > 0) arrival_.froude_mean = f.momentum.x() / mass / std::sqrt(g * f.deepest);
}

}  // namespace lahar::cases
