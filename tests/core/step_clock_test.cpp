#include "core/step_clock.h"

#include <gtest/gtest.h>

#include "core/memory_archive.h"

namespace lahar {
namespace {

TEST(StepClock, IsTheProductWhileTheStepStays) {
  StepClock clock(0.1);
  for (int k = 0; k < 1000; ++k) clock.advance();
  EXPECT_EQ(clock.time(), 1000 * 0.1);  // a sum of 1000 terms would not be
  EXPECT_EQ(clock.steps(), 1000);
}

TEST(StepClock, GoesOnWithAnotherStep) {
  StepClock clock(0.5);
  clock.advance(), clock.advance();
  clock.set_time_step(0.25);
  EXPECT_EQ(clock.time(), 1.0);
  clock.advance();
  EXPECT_EQ(clock.time(), 1.25);
  EXPECT_EQ(clock.time_step(), 0.25);
  StepClock other(7);
  StoredState stored = state_of(clock);
  load_state(stored, other);
  other.advance();
  EXPECT_EQ(other.time(), 1.5);
  EXPECT_EQ(other.steps(), 4);
}

}  // namespace
}  // namespace lahar
