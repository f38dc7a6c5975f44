#pragma once
// The time step of a fluid that adapts it.
#include "cases/observers/observer.h"

namespace lahar::cases {

class FluidTimeStep final : public Observer {
 public:
  explicit FluidTimeStep(const Observed& run);
  static bool applies(const Observed& run) { return run.scene.fluid.adaptive_time_step && run.simulation.fluid(); }
  [[nodiscard]] std::string_view name() const override { return "fluid_time_step"; }
};

}  // namespace lahar::cases
