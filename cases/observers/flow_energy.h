#pragma once
// Energy and Froude numbers of the flow that arrives at the measured section, and energy that leaves behind it.
#include "cases/observers/flow.h"
#include "cases/observers/grains.h"
#include "cases/observers/observer_list.h"
#include "cases/observers/outflow.h"

namespace lahar::cases {

class FlowEnergy final : public Observer {
 public:
  FlowEnergy(const Observed& run, const ObserverList& before);
  static bool applies(const Observed& run) { return run.section && run.simulation.fluid(); }
  [[nodiscard]] std::string_view name() const override { return "flow_energy"; }
  void sample(double interval) override;
  void transfer(Archive& archive) override { archive.value("has_arrived", has_arrived_); }

 private:
  struct Arrival {
    double energy = kUnknown;                                  ///< kJ
    double froude_deepest = kUnknown, froude_mean = kUnknown;  ///< 1
    double depth = kUnknown;                                   ///< m
  };
  void take_arrival();

  const Flow& flow_;
  const Outflow& outflow_;
  const Grains* grains_;
  Arrival arrival_;  // known at the row of the arrival alone: the metrics keep it
  bool has_arrived_ = false;
};

}  // namespace lahar::cases
