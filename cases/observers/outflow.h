#pragma once
// Liquid that passes the outflow section, `measure.outflow_distance_m` beyond the measured one.
#include "cases/observers/flow.h"
#include "cases/observers/observer_list.h"

namespace lahar::cases {

class Outflow final : public Observer {
 public:
  Outflow(const Observed& run, const ObserverList& before);
  static bool applies(const Observed& run) { return run.section && run.simulation.fluid(); }
  [[nodiscard]] std::string_view name() const override { return "outflow"; }
  void sample(double interval) override;
  void transfer(Archive& archive) override;
  /// J, passed so far.
  [[nodiscard]] double energy() const { return energy_; }

 private:
  const Flow& flow_;
  double energy_ = 0, kinetic_ = 0, mass_ = 0;  ///< J, J, kg
};

}  // namespace lahar::cases
