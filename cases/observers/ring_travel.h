#pragma once
// How far the edge rings of a net have slid along their cables.
#include <vector>

#include "barrier/threading.h"
#include "cases/observers/observer.h"

namespace lahar::cases {

class RingTravel final : public Observer {
 public:
  explicit RingTravel(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.net() && !run.simulation.net()->rings.empty(); }
  [[nodiscard]] std::string_view name() const override { return "ring_travel"; }
  void sample(double interval) override;
  void transfer(Archive& archive) override { archive.list("start", start_); }

 private:
  std::vector<barrier::Threading> threads_;
  std::vector<double> start_;  // m, barrier::places_on_cables at the first row
  barrier::Travel now_;
};

}  // namespace lahar::cases
