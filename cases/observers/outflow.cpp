#include "cases/observers/outflow.h"

namespace lahar::cases {

Outflow::Outflow(const Observed& run, const ObserverList& before) : Observer(run), flow_(*before.find<Flow>()) {
  column("section_power_W", "W",
         "energy flux of the liquid, kinetic and potential, `measure.outflow_distance_m` beyond the measured section",
         [this] { return flow_.now().outflow_power; });
  result("liquid_passed_kg", "kg", "liquid that passed `measure.outflow_distance_m` beyond the measured section",
         [this] { return mass_; });
  result("e_out_liquid_kinetic_kJ", "kJ", "kinetic energy of that liquid", [this] { return kinetic_ / 1000; });
  result("e_out_liquid_potential_kJ", "kJ", "potential energy of that liquid",
         [this] { return (energy_ - kinetic_) / 1000; });
}

void Outflow::sample(double interval) {
  energy_ += flow_.now().outflow_power * interval;
  kinetic_ += flow_.now().outflow_kinetic_power * interval;
  mass_ += flow_.now().outflow_rate * interval;
}

void Outflow::transfer(Archive& archive) {
  archive.value("energy", energy_);
  archive.value("kinetic", kinetic_);
  archive.value("mass", mass_);
}

}  // namespace lahar::cases
