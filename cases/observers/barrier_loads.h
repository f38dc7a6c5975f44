#pragma once
// What water and grains do to the barrier.
#include <array>

#include "cases/observers/observer.h"

namespace lahar::cases {

class BarrierLoads final : public Observer {
 public:
  explicit BarrierLoads(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.net() != nullptr; }
  [[nodiscard]] std::string_view name() const override { return "barrier_loads"; }
  void after_step() override;
  void sample(double interval) override;
  void transfer(Archive& archive) override;

 private:
  enum Load : std::size_t { of_water, of_contacts, loads };
  [[nodiscard]] std::array<Vec3, loads> now() const;

  std::array<Vec3, loads> impulse_{};  // N s, since the last row
  std::array<Vec3, loads> mean_{};     // N, of the last row
  std::array<double, loads> total_{};  // N s along the flow, since the start
};

}  // namespace lahar::cases
