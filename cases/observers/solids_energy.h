#pragma once
// Where the energy of grains and barrier went: friction, dampers, the liquid; and whether the books close.
#include <cmath>

#include "cases/observers/observer.h"
#include "dem/energy.h"

namespace lahar::cases {

class SolidsEnergy final : public Observer {
 public:
  explicit SolidsEnergy(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.solids() != nullptr; }
  [[nodiscard]] std::string_view name() const override { return "solids_energy"; }
  void sample(double interval) override;
  void transfer(Archive& archive) override;
  [[nodiscard]] std::vector<ResultCheck> checks(const Metrics& metrics) const override;

 private:
  /// J, of the last row, less what the first had: only what the run itself brought.
  [[nodiscard]] double friction() const { return now_.friction + now_.rolling - friction_at_start_; }
  [[nodiscard]] double damping() const { return now_.contact_damping - damping_at_start_; }
  [[nodiscard]] double bonds() const { return now_.bonds.dissipated() - bonds_at_start_; }
  [[nodiscard]] double work() const { return now_.external_work - work_at_start_; }
  [[nodiscard]] double turned_over() const {
    return now_.kinetic + now_.rotational + friction() + damping() + bonds() + std::abs(work());
  }
  [[nodiscard]] double gap() const { return now_.total() - total_at_start_; }

  dem::EnergyLedger now_;
  bool started_ = false;
  double total_at_start_ = 0, friction_at_start_ = 0, damping_at_start_ = 0, bonds_at_start_ = 0, work_at_start_ = 0;
};

}  // namespace lahar::cases
