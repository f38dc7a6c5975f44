#pragma once
// Energy, front and profile of the liquid: one look at all wet cells, which other observers share.
#include "cases/observers/observer.h"

namespace lahar::cases {

/// Sums over the wet cells at one moment.
struct FlowFigures {
  double kinetic = 0, potential = 0;      ///< J, about the datum
  Vec3 momentum = Vec3::Zero();           ///< kg m/s
  double front = 0;                       ///< m: mean over the width of the foremost bed cell more than half full
  double outflow_power = 0;               ///< W, energy flux through the outflow section
  double outflow_kinetic_power = 0;       ///< W, the kinetic part of it
  double outflow_rate = 0;                ///< kg/s through that section
  double beyond_outflow = 0;              ///< kg beyond it
  double deepest = 0, deepest_speed = 0;  ///< m, m/s at the section with the largest depth
};

/// Looks at the fluid, which the run must have.
FlowFigures look_at_flow(const Observed& run);

class Flow final : public Observer {
 public:
  explicit Flow(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.fluid() != nullptr; }
  [[nodiscard]] std::string_view name() const override { return "flow"; }
  void sample(double) override { now_ = look_at_flow(run_); }
  [[nodiscard]] const FlowFigures& now() const { return now_; }

 private:
  FlowFigures now_;
};

}  // namespace lahar::cases
