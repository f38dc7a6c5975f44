#include "cases/observers/outflow.h"

#include <cmath>

namespace lahar::cases {

Outflow::Outflow(const Observed& run, const ObserverList& before) : Observer(run), flow_(*before.find<Flow>()) {
  column("section_power_W", "W",
         "energy flux of the liquid, kinetic and potential, `measure.outflow_distance_m` beyond the measured section",
         [this] { return flow_.now().outflow_power; });
  result("liquid_passed_kg", "kg", "liquid that came past the outflow section, or is gone", [this] { return passed_; });
  result("e_out_liquid_kinetic_kJ", "kJ",
         "kinetic energy of that liquid: per mass the mean of what crosses the outflow section; absent where liquid is "
         "gone and none crossed there",
         [this] { return energy().kinetic / 1000; })
      .unknown_at_times();
  result("e_out_liquid_potential_kJ", "kJ", "potential energy of that liquid, in the same way", [this] {
    return energy().potential / 1000;
  }).unknown_at_times();
}

void Outflow::sample(double interval) {
  const FlowFigures& f = flow_.now();
  energy_ += f.outflow_power * interval;
  kinetic_ += f.outflow_kinetic_power * interval;
  mass_ += f.outflow_rate * interval;
  const double gone = run_.simulation.fluid()->transfers().left + f.beyond_outflow;
  if (std::isnan(at_start_)) at_start_ = gone;
  passed_ = gone - at_start_;
}

OutflowEnergy Outflow::energy() const {
  if (mass_ <= 0) return passed_ > 0 ? OutflowEnergy{kUnknown, kUnknown} : OutflowEnergy{};
  return {passed_ * kinetic_ / mass_, passed_ * (energy_ - kinetic_) / mass_};
}

void Outflow::transfer(Archive& archive) {
  archive.value("energy", energy_);
  archive.value("kinetic", kinetic_);
  archive.value("mass", mass_);
  archive.value("at_start", at_start_);
}

}  // namespace lahar::cases
