#include "cases/observers/liquid_mass.h"

namespace lahar::cases {

LiquidMass::LiquidMass(const Observed& run) : Observer(run) {
  const FluidView& fluid = *run.simulation.fluid();
  column("liquid_mass_kg", "kg", "liquid in the domain", [this] { return now_; });
  column("outflow_mass_kg", "kg", "liquid that left through open faces", [&] { return fluid.transfers().left; });
  column("liquid_mass_drift_rel", "1",
         "(in the domain + left - come in - rescaled - at the start) / (at the start + come in)",
         [this, &fluid] { return fluid.mass_drift(now_); })
      .peak_magnitude("liquid_mass_drift_rel", "largest `liquid_mass_drift_rel` of the rows, without its sign");
  result("liquid_mass_start_kg", "kg",
         "liquid at the start; a depth h that walls bear holds g h / (2 c_s^2) more under its own weight, c_s = cell "
         "size / (sqrt 3 "
         "time step)",
         [&] {
           const LiquidTransfers t = fluid.transfers();
           return fluid.liquid_mass() + t.left - t.came_in - t.rescaled;
         });
  if (!run.scene.fluid.inflows.empty())
    result("liquid_inflow_kg", "kg", "liquid that came in through inflow boxes",
           [&] { return fluid.transfers().came_in; });
  result("liquid_wall_balance_kg", "kg",
         "mass that walls took from cells and got back: interpolated, moving or slipping in steps; absent if none",
         [&] {
           const double returned = fluid.transfers().wall_balance;
           return returned > 0 ? returned : kUnknown;
         })
      .unknown_at_times();
  result("liquid_left_kg", "kg", "liquid that left through open faces", [&] { return fluid.transfers().left; });
  result("liquid_paid_nearby_kg", "kg",
         "liquid that cells near by got or paid for bodies that cross the surface and cells that they cover",
         [&] { return fluid.transfers().paid_nearby; });
  result("liquid_pooled_kg", "kg", "liquid that went through the pool of isolated cells, either way",
         [&] { return fluid.transfers().pooled; });
}

std::vector<ResultCheck> LiquidMass::checks(const Metrics& metrics) const {
  return vanishes(metrics, "liquid_mass_drift_rel", "liquid_mass_ledger", 1e-4, "conservation of mass");
}

}  // namespace lahar::cases
