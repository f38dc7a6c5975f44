#pragma once
// When something that is written at intervals is due.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/archive.h"

namespace lahar::cases {

class Schedule {
 public:
  /// Every `interval` s of simulated time from 0 on; never for 0.
  explicit Schedule(double interval) : interval_(interval) {}

  /// Whether any are asked for.
  [[nodiscard]] bool runs() const { return interval_ > 0; }
  [[nodiscard]] bool due(double time) const {
    return runs() && time + rounding() >= from_ + static_cast<double>(since_) * interval_;
  }
  /// Whether the end of a run at `time` has none of its own yet.
  [[nodiscard]] bool wants_last(double time) const { return runs() && is_behind(time); }
  /// Whether none was written at `time` or later.
  [[nodiscard]] bool is_behind(double time) const { return last_ < time; }
  /// One was written.
  void note(double time) {
    ++done_;
    last_ = time;
    skip_until(time);
  }
  /// Leaves out those that were due until a time. Where that is beyond the precision of numbers, of an interval far
  /// shorter than any step, one is due at every step.
  void skip_until(double time) {
    if (!due(time)) return;
    const double passed = std::floor((time + rounding() - from_) / interval_);
    since_ = std::max(since_, static_cast<std::int64_t>(std::min(passed, kMostCounted)) - 1);
    for (int k = 0; k < 3 && due(time); ++k) ++since_;  // rounding moves the division by one at most
  }
  /// How many were written.
  [[nodiscard]] std::int64_t done() const { return done_; }

  /// An interval that was changed for the rest of a run counts from the last one written, or from the next step on.
  void transfer(Archive& archive) {
    double interval = interval_;
    archive.value("interval", interval);
    archive.value("from", from_);
    archive.value("done", done_);
    archive.value("since", since_);
    archive.value("last", last_);
    if (interval == interval_) return;
    from_ = last_ >= 0 ? last_ + interval_ : 0;
    since_ = 0;
  }

 private:
  /// s, so that none is missed by rounding: far below a step, also where many make a short interval.
  [[nodiscard]] double rounding() const { return std::min(1e-9, 1e-5 * interval_); }

  static constexpr double kMostCounted = 0x1p62;  ///< fits into 64 bits

  double interval_, from_ = 0, last_ = -1;
  std::int64_t done_ = 0, since_ = 0;
};

}  // namespace lahar::cases
