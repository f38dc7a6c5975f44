#pragma once
// Forces, elongation and energy of the barrier, and the chart of its cables.
#include <array>

#include "barrier/response.h"
#include "cases/observers/observer.h"

namespace lahar::cases {

class BarrierResponse final : public Observer {
 public:
  explicit BarrierResponse(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.net() != nullptr; }
  [[nodiscard]] std::string_view name() const override { return "barrier"; }
  void sample(double interval) override;
  void transfer(Archive& archive) override;
  /// cable_forces.png: sums of bond forces in the four cables over time.
  void finish(const std::filesystem::path& folder) const override;

 private:
  void declare_component(barrier::Component component);
  void declare_ends(barrier::Component cable);
  void declare_foundations();
  /// J, elastic and potential.
  [[nodiscard]] double stored_energy() const {
    return now_[barrier::Component::barrier].energy.elastic() + now_.potential_energy;
  }

  barrier::BarrierResponse now_;
  std::vector<double> times_;                      // s, of the rows
  std::array<std::vector<double>, 4> cable_sums_;  // kN, of the first four components
};

}  // namespace lahar::cases
