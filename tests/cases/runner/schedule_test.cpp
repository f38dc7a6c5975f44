#include "cases/runner/schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/memory_archive.h"

namespace lahar::cases {
namespace {

TEST(Schedule, IsDueAtEveryInterval) {
  Schedule s(0.1);
  EXPECT_TRUE(s.due(0));
  s.note(0);
  EXPECT_FALSE(s.due(0.09));
  EXPECT_TRUE(s.due(0.1));
  s.note(0.1);
  EXPECT_FALSE(s.due(0.19));
  s.note(0.55);  // those of 0.2 to 0.5 are left out
  EXPECT_FALSE(s.due(0.59));
  EXPECT_TRUE(s.due(0.6));
  EXPECT_EQ(s.done(), 3);
}

TEST(Schedule, IsNeverDueWithoutAnInterval) {
  Schedule s(0);
  s.note(1);
  EXPECT_FALSE(s.due(2));
  EXPECT_FALSE(s.wants_last(2));
}

/// Steps that hit the intervals but for rounding: counted one by one, they are the same.
TEST(Schedule, NoneIsMissedNorTwiceDueByRounding) {
  for (const double interval : {0.1, 0.01, 1.0 / 3, 1e-3, 7e-5}) {
    Schedule s(interval);
    std::int64_t due = 0;
    for (int step = 0; step <= 20000; ++step) {
      const double time = 0.5 * interval * step;
      EXPECT_EQ(s.due(time), step % 2 == 0) << interval << " at step " << step;
      if (!s.due(time)) continue;
      s.note(time);
      ++due;
      EXPECT_FALSE(s.due(time)) << interval << " at step " << step;
    }
    EXPECT_EQ(due, 10001);
  }
}

/// Due at 0, 2, 4 ns and so on, not before.
TEST(Schedule, AnIntervalOfNanoseconds) {
  Schedule s(2e-9);
  for (int step = 0; step <= 100; ++step) {
    const double time = 1e-10 * step;
    EXPECT_EQ(s.due(time), step % 20 == 0) << "at step " << step;
    if (s.due(time)) s.note(time);
  }
  EXPECT_EQ(s.done(), 6);
}

/// A run that was stopped between rows and goes on with another interval: rows follow the last one by it, or from the
/// next step on where that is past.
TEST(Schedule, AnIntervalChangedForTheRestOfARun) {
  const auto rows_after = [](double before, double after, double stopped) {
    Schedule first(before), second(after);
    for (int step = 0; 1e-3 * step <= stopped + 1e-9; ++step)
      if (first.due(1e-3 * step)) first.note(1e-3 * step);
    StoredState state = state_of(first);
    load_state(state, second);
    std::vector<int> rows;  // ms
    for (int step = static_cast<int>(std::lround(1e3 * stopped)) + 1; step <= 500 && rows.size() < 3; ++step) {
      if (!second.due(1e-3 * step)) continue;
      second.note(1e-3 * step);
      rows.push_back(step);
    }
    return rows;
  };
  EXPECT_EQ(rows_after(0.01, 0.1, 0.137), (std::vector{230, 330, 430}));
  EXPECT_EQ(rows_after(0.1, 0.01, 0.137), (std::vector{138, 140, 150}));
  EXPECT_EQ(rows_after(0.01, 0.01, 0.137), (std::vector{140, 150, 160}));
}

/// Counting would take forever.
TEST(Schedule, AnIntervalFarShorterThanAStep) {
  for (const double interval : {1e-9, 1e-12, 1e-15, 1e-300}) {
    Schedule s(interval);
    for (const double time : {0.0, 0.3, 0.3001, 1e6}) {
      EXPECT_TRUE(s.due(time)) << interval << " at " << time;
      s.note(time);
    }
    EXPECT_EQ(s.done(), 4);
  }
}

}  // namespace
}  // namespace lahar::cases
