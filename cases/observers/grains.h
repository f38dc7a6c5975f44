#pragma once
// Energy and front of the grains, and those that have passed.
#include <cstdint>

#include "cases/observers/observer.h"

namespace lahar::cases {

class Grains final : public Observer {
 public:
  explicit Grains(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.solids() != nullptr; }
  [[nodiscard]] std::string_view name() const override { return "grains"; }
  void sample(double interval) override;
  void transfer(Archive& archive) override;
  /// J, of all grains at the last row.
  [[nodiscard]] double energy() const { return kinetic_ + potential_; }
  /// J, that grains took with them beyond the outflow section.
  [[nodiscard]] double energy_out() const { return energy_out_; }

 private:
  double kinetic_ = 0, potential_ = 0, front_ = 0, passed_ = 0;  // J, J, m, kg at the last row
  std::vector<std::uint8_t> crossed_;                            // per particle: beyond the outflow section
  double energy_out_ = 0, kinetic_out_ = 0;
};

}  // namespace lahar::cases
