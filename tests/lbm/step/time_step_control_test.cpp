#include "lbm/step/time_step_control.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lahar::lbm {
namespace {

TimeStepLimits limits() {
  TimeStepLimits l;
  l.cell_size = 0.01;
  l.shortest = 1e-5, l.longest = 1e-2;
  return l;
}

LiquidSpeed look(double speed, double pressure_speed = 0) { return {true, speed, std::max(speed, pressure_speed)}; }

/// A control that has had its first look.
TimeStepControl running(const TimeStepLimits& l = limits()) {
  TimeStepControl control(l);
  control.choose(1e-3, look(0.1));
  return control;
}

double after_calm(TimeStepControl& control, double time_step, const LiquidSpeed& s, int looks) {
  double chosen = time_step;
  for (int k = 0; k < looks && chosen == time_step; ++k) chosen = control.choose(time_step, s);
  return chosen;
}

TEST(TimeStepControl, ShortensAtOnceToTheTarget) {
  auto control = running();
  EXPECT_EQ(control.choose(1e-3, look(0.149)), 1e-3);
  EXPECT_NEAR(control.choose(1e-3, look(0.16)), 1e-3 * 0.1 / 0.16, 1e-12);
  EXPECT_NEAR(control.choose(1e-3, look(0.35)), 0.5e-3, 1e-12);  // no more than by half
  EXPECT_EQ(control.choose(1.2e-5, look(0.3)), 1e-5);
  EXPECT_FALSE(control.can_shorten(1e-5));
  EXPECT_EQ(control.choose(1e-5, look(0.3)), 1e-5);
}

TEST(TimeStepControl, GrowsAfterSixteenCalmLooks) {
  auto control = running();
  EXPECT_EQ(after_calm(control, 1e-3, look(0.05), 15), 1e-3);
  EXPECT_NEAR(control.choose(1e-3, look(0.05)), 1.25e-3, 1e-12);
  EXPECT_EQ(after_calm(control, 1e-3, look(0.05), 15), 1e-3);
  EXPECT_EQ(control.choose(1e-3, look(0.08)), 1e-3);  // a fast look: to be counted anew
  EXPECT_EQ(after_calm(control, 1e-3, look(0.05), 15), 1e-3);
  EXPECT_NEAR(after_calm(control, 1e-3, look(0.0699), 17), 1e-3 * 0.085 / 0.0699, 1e-12);
}

TEST(TimeStepControl, NothingGrowsOnPressureFallWallsOrAnEmptyTank) {
  auto control = running();
  EXPECT_EQ(after_calm(control, 1e-3, look(0, 0.0702), 40), 1e-3);
  EXPECT_EQ(after_calm(control, 1e-3, LiquidSpeed{}, 40), 1e-3);
  TimeStepLimits l = limits();
  l.known_speed = 0.71;  // 0.071 lu
  control = running(l);
  EXPECT_EQ(after_calm(control, 1e-3, look(0), 40), 1e-3);
  l.known_speed = 0, l.gravity = 26;  // sqrt(2 g dx) = 0.72 m/s
  control = running(l);
  EXPECT_EQ(after_calm(control, 1e-3, look(0), 40), 1e-3);
  EXPECT_GT(after_calm(control, 0.9e-3, look(0), 40), 0.9e-3);
}

/// A boulder in the air is in no cell, and falls into water at rest.
TEST(TimeStepControl, FollowsBodiesThatAreNotInTheLiquid) {
  auto control = running();
  LiquidSpeed calm = look(0.01);
  calm.bodies = 0.099;
  EXPECT_EQ(after_calm(control, 1e-3, calm, 40), 1e-3);
  calm.bodies = 0.16;
  EXPECT_NEAR(control.choose(1e-3, calm), 1e-3 * 0.1 / 0.16, 1e-12);
}

TEST(TimeStepControl, PressureShortensAtTheFirstLookAlone) {
  TimeStepControl control(limits());
  EXPECT_NEAR(control.choose(1e-3, look(0, 0.4)), 0.25e-3, 1e-9);
  EXPECT_EQ(control.choose(1e-3, look(0, 0.4)), 1e-3);
}

TEST(TimeStepControl, StaysWithinItsLimits) {
  auto control = running();
  EXPECT_EQ(after_calm(control, 0.9e-2, look(0.01), 16), 1e-2);
  EXPECT_EQ(after_calm(control, 1e-2, look(0.01), 100), 1e-2);
}

}  // namespace
}  // namespace lahar::lbm
