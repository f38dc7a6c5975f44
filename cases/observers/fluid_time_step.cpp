#include "cases/observers/fluid_time_step.h"

namespace lahar::cases {

FluidTimeStep::FluidTimeStep(const Observed& run) : Observer(run) {
  const FluidView& fluid = *run.simulation.fluid();
  column("fluid_time_step_s", "s", "length of the fluid's last step, where it adapts",
         [&] { return fluid.units().time_step; });
  result("fluid_time_step_min_s", "s", "shortest step of the fluid; with an adaptive step, as the next four",
         [&] { return fluid.time_step_record().shortest; });
  result("fluid_time_step_max_s", "s", "longest step of the fluid", [&] { return fluid.time_step_record().longest; });
  result("fluid_time_step_changes", "1", "how often the step changed",
         [&] { return static_cast<double>(fluid.time_step_record().changes); });
  result("fluid_steps", "1", "steps of the fluid", [&] { return static_cast<double>(fluid.steps()); });
  result("liquid_rescaled_kg", "kg", "mass that changes of the step have added: they keep the volume (fluid.md)",
         [&] { return fluid.transfers().rescaled; });
}

}  // namespace lahar::cases
