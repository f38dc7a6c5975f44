#pragma once
// Liquid that passes the outflow section, `measure.outflow_distance_m` beyond the measured one.
#include "cases/observers/flow.h"
#include "cases/observers/observer_list.h"

namespace lahar::cases {

/// J.
struct OutflowEnergy {
  double kinetic = 0, potential = 0;
  [[nodiscard]] double sum() const { return kinetic + potential; }
};

/// The rate through cells that are partly full (level times velocity) is more than the mass that goes, by up to a
/// twentieth in streams, by an eighth in trickles and spray: these wait for their cells to fill. So the ledger says how
/// much has passed, the rates what energy it had.
class Outflow final : public Observer {
 public:
  Outflow(const Observed& run, const ObserverList& before);
  static bool applies(const Observed& run) { return run.section && run.simulation.fluid(); }
  [[nodiscard]] std::string_view name() const override { return "outflow"; }
  void sample(double interval) override;
  void transfer(Archive& archive) override;
  /// Passed so far. NaN where liquid has left the domain and none crossed the section: nothing is known of it.
  [[nodiscard]] OutflowEnergy energy() const;

 private:
  const Flow& flow_;
  double energy_ = 0, kinetic_ = 0, mass_ = 0;  ///< J, J, kg: rates of the rows times their intervals
  double at_start_ = kUnknown;                  ///< kg beyond the section at the first row
  double passed_ = 0;                           ///< kg, at the last row
};

}  // namespace lahar::cases
