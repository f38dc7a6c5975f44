#pragma once
// The ledger of the liquid's momentum along x, down the slope.
#include "cases/observers/liquid_mass.h"
#include "cases/observers/observer_list.h"

namespace lahar::cases {

/// Liquid has the momentum that its weight gave it and that inflows brought, less what bodies got and what left took
/// along, all booked step by step. The rest is of the walls; and of the surface: cells at it move as if they were full
/// (docs/decisions/0072). Where the bed slips and no wall stands across the stream it is the error of the method. What
/// leaves in a step is taken to be as fast as the cells at open faces are, by what flows out of each.
class LiquidMomentum final : public Observer {
 public:
  LiquidMomentum(const Observed& run, const ObserverList& before);
  static bool applies(const Observed& run) { return run.simulation.fluid() && run.simulation.solids(); }
  [[nodiscard]] std::string_view name() const override { return "liquid_momentum"; }
  void after_step() override;
  void sample(double interval) override;
  void transfer(Archive& archive) override;

 private:
  [[nodiscard]] double force_on_bodies() const;
  [[nodiscard]] double entry_speed(double interval) const;

  const LiquidMass& in_domain_;
  double now_ = 0;                            ///< Ns, at the last row
  double at_start_ = kUnknown;                ///< Ns, at the first row
  double given_ = 0;                          ///< Ns, by weight and inflows less to bodies and what left, since then
  double exit_speed_ = 0, entry_speed_ = 0;   ///< m/s, along x, of what left and came in last
  double mass_ = 0, left_ = 0, came_in_ = 0;  ///< kg, at the last step; the mass by the ledger since the last row
};

}  // namespace lahar::cases
