#pragma once
// Loose grains that the barrier holds.
#include "cases/observers/observer.h"

namespace lahar::cases {

/// Shares of the grains that are held; not a number where there are none of the kind.
struct Retained {
  double mass = kUnknown;
  double small = kUnknown, large = kUnknown;  ///< by number, below and above the middle of the radii
};

class Retention final : public Observer {
 public:
  explicit Retention(const Observed& run);
  static bool applies(const Observed& run) { return run.section && run.simulation.solids(); }
  [[nodiscard]] std::string_view name() const override { return "retention"; }

 private:
  [[nodiscard]] double reach_of(const barrier::Net& net) const;
  [[nodiscard]] Retained now() const;
};

}  // namespace lahar::cases
