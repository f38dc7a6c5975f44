#pragma once
// The ledger of the liquid's mass.
#include "cases/observers/observer.h"

namespace lahar::cases {

class LiquidMass final : public Observer {
 public:
  explicit LiquidMass(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.fluid() != nullptr; }
  [[nodiscard]] std::string_view name() const override { return "liquid_mass"; }
  void sample(double) override { now_ = run_.simulation.fluid()->liquid_mass(); }
  /// kg in the domain, at the last row.
  [[nodiscard]] double now() const { return now_; }
  [[nodiscard]] std::vector<ResultCheck> checks(const Metrics& metrics) const override;

 private:
  double now_ = 0;  ///< kg, at the last row
};

}  // namespace lahar::cases
