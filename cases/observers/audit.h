#pragma once
// Momentum that fluid and solids gave each other, booked on both sides.
#include "cases/observers/observer.h"

namespace lahar::cases {

class Audit final : public Observer {
 public:
  explicit Audit(const Observed& run) : Observer(run) {
    result("momentum_audit_rel", "1",
           "sum over the steps of (given to the solids - taken from the fluid), over what was exchanged",
           [this] { return run_.simulation.audit().relative(); });
  }
  static bool applies(const Observed& run) { return run.simulation.fluid() && run.simulation.solids(); }
  [[nodiscard]] std::string_view name() const override { return "audit"; }
  [[nodiscard]] std::vector<ResultCheck> checks(const Metrics& metrics) const override {
    return vanishes(metrics, "momentum_audit_rel", "momentum_audit", 1e-6, "action = reaction");
  }
};

}  // namespace lahar::cases
