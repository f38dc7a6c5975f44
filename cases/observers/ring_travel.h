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
  [[nodiscard]] std::vector<double> places() const;

  std::vector<barrier::Threading> threads_;
  std::vector<double> start_;  // m along its cable as made, by thread, at the first row; NaN where it does not pass
  double mean_ = 0, furthest_ = 0;  // m
};

}  // namespace lahar::cases
