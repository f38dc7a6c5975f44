#pragma once
// Time as a count of steps whose length may change.
#include <cstdint>

#include "core/archive.h"

namespace lahar {

/// Counts from the last change of the step, so that time is exact to one rounding while the step stays the same.
class StepClock {
 public:
  explicit StepClock(double time_step = 0) { state_.time_step = time_step; }

  void advance() { ++state_.steps; }
  /// The coming steps have another length, s.
  void set_time_step(double time_step) {
    state_.start = time();
    state_.since = state_.steps;
    state_.time_step = time_step;
  }

  [[nodiscard]] double time_step() const { return state_.time_step; }  ///< s
  [[nodiscard]] std::int64_t steps() const { return state_.steps; }
  [[nodiscard]] double time() const {  ///< s
    return state_.start + static_cast<double>(state_.steps - state_.since) * state_.time_step;
  }
  void transfer(Archive& archive) {
    archive.value("time_step", state_.time_step);
    archive.value("start", state_.start);
    archive.value("since", state_.since);
    archive.value("steps", state_.steps);
  }

 private:
  struct State {
    double time_step = 0;    ///< s, of the coming steps
    double start = 0;        ///< s, when the step took this length
    std::int64_t since = 0;  ///< steps at that moment
    std::int64_t steps = 0;
  };
  State state_;
};

}  // namespace lahar
