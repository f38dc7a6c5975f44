#pragma once
// What the liquid does to the grains.
#include "cases/observers/observer.h"

namespace lahar::cases {

class GrainLoads final : public Observer {
 public:
  explicit GrainLoads(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.fluid() && run.simulation.solids(); }
  [[nodiscard]] std::string_view name() const override { return "grain_loads"; }
  void after_step() override;
  void sample(double interval) override;
  void transfer(Archive& archive) override;

 private:
  Vec3 impulse_ = Vec3::Zero();  // N s, since the last row
  Vec3 mean_ = Vec3::Zero();     // N, of the last row
};

}  // namespace lahar::cases
