#pragma once
// How long the next fluid step may be (docs/decisions/0010).
//
// A stated share of the wet cells, the fastest, is not counted: drops and jets of a splash, whose speed is limited
// (collision/cell_state.h) and says little about the flow.
// The speed is the largest of the liquid and of bodies that it may meet.
// Too fast: a speed beyond 1.5 times the target shortens the step at once, so that it comes to the target, by at most
// half. Calm: when at 16 looks in a row the largest of
//   the speed, what its pressure can give to the liquid (Bernoulli, u^2 = 2 p / rho = 2/3 (rho - 1)), a fall by one
//   cell, walls and inflows
// stayed under 0.7 times the target, the step grows, by at most a quarter, so that this speed comes to 0.85 times the
// target. The gap between 0.85 and 1.5 keeps the step from swinging (Thuerey et al. 2006 use one number for both). The
// pressure shortens a step only at the first look: later it may be a hammer of the lattice fluid, which is sound. That
// first cut may be of any size: liquid that is too compressed would expand before the next look.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/archive.h"

namespace lahar::lbm {

inline constexpr std::int64_t kLookEvery = 8;  ///< steps between two looks

/// SI, but for the target.
struct TimeStepLimits {
  double target = 0.1;     ///< lu, of the largest speed that counts
  double uncounted = 0;    ///< share of the wet cells, the fastest, that do not count
  double cell_size = 0;    ///< m
  double shortest = 0;     ///< s
  double longest = 0;      ///< s: by the viscosity, see fluid_options.cpp
  double gravity = 0;      ///< m/s^2
  double known_speed = 0;  ///< m/s, that walls and inflows have whatever the liquid does
};

/// What the step has been so far.
struct TimeStepRecord {
  double shortest = 0, longest = 0;  ///< s
  std::int64_t changes = 0;

  explicit TimeStepRecord(double time_step = 0) : shortest(time_step), longest(time_step) {}
  void note(double time_step) {
    shortest = std::min(shortest, time_step);
    longest = std::max(longest, time_step);
    ++changes;
  }
  void transfer(Archive& archive) {
    archive.value("shortest", shortest);
    archive.value("longest", longest);
    archive.value("changes", changes);
  }
};

/// What a look at the liquid found over the wet cells that count, lattice units.
struct LiquidSpeed {
  bool any = false;   ///< whether there is liquid
  double speed = 0;   ///< of the fastest
  double reach = 0;   ///< the largest of speeds and what pressures can give
  double bodies = 0;  ///< of the fastest that may meet the liquid; on their way through the gas they are in no cell
};

class TimeStepControl {
 public:
  explicit TimeStepControl(const TimeStepLimits& limits) : limits_(limits) {}

  /// s: the step to go on with, after a look at the liquid at the end of a step of length `time_step`.
  double choose(double time_step, const LiquidSpeed& look) {
    if (!look.any) return time_step;
    const double fast = std::max(first_ ? look.reach : look.speed, look.bodies);
    const double largest_cut = first_ ? 0 : kLargestCut;
    first_ = false;
    if (fast > kTooFast * limits_.target) {
      calm_looks_ = 0;
      return bounded(time_step, std::max(largest_cut, limits_.target / fast));
    }
    const double speed = std::max({look.reach, look.bodies, other_speed(time_step)});
    calm_looks_ = speed < kCalm * limits_.target ? calm_looks_ + 1 : 0;
    if (calm_looks_ < kCalmLooks) return time_step;
    calm_looks_ = 0;
    return bounded(time_step, std::min(kLargestGrowth, kAfterGrowth * limits_.target / speed));
  }

  /// Whether a step may still be shortened.
  [[nodiscard]] bool can_shorten(double time_step) const { return time_step > limits_.shortest * (1 + 1e-9); }
  [[nodiscard]] const TimeStepLimits& limits() const { return limits_; }

  void transfer(Archive& archive) {
    archive.value("calm_looks", calm_looks_);
    archive.value("first", first_);
  }

 private:
  static constexpr double kTooFast = 1.5, kCalm = 0.7, kAfterGrowth = 0.85;  // of the target
  static constexpr double kLargestCut = 0.5, kLargestGrowth = 1.25;          // of the step
  static constexpr int kCalmLooks = 16;

  /// lu: a fall by one cell, walls and inflows.
  [[nodiscard]] double other_speed(double time_step) const {
    const double to_lu = time_step / limits_.cell_size;
    return std::max({to_lu * std::sqrt(2 * limits_.gravity * limits_.cell_size), to_lu * limits_.known_speed, 1e-12});
  }
  [[nodiscard]] double bounded(double time_step, double factor) const {
    const double longest = std::max(limits_.longest, limits_.shortest);
    return std::clamp(factor * time_step, std::min(time_step, limits_.shortest), std::max(time_step, longest));
  }

  TimeStepLimits limits_;
  int calm_looks_ = 0;
  bool first_ = true;
};

}  // namespace lahar::lbm
