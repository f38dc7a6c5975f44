#include "coupling/grains/drag_over_a_step.h"

#include <gtest/gtest.h>

namespace lahar::coupling {
namespace {

/// A slip that a constant force drives against its drag: x of a step is `rate` times its length.
struct DrivenSlip {
  double rate, acceleration, time_step;
  double slip = 0;
  DraggedSlip dragged = {};

  /// m/s^2 that the drag takes off, worked out for the present step; it acts over the next, which is `ratio` as long.
  double advance(double ratio = 1) {
    dragged.begin(Vec3(slip, 0, 0));
    const double off = dragged.drag(rate * time_step).x() / time_step;
    dragged.stretch(ratio);
    time_step *= ratio;
    slip += (acceleration - off) * time_step;
    return off;
  }
};

TEST(DraggedSlip, BalancesWhatDrivesIt) {
  for (const double x : {0.01, 1.0, 50.0}) {
    DrivenSlip s{.rate = 1e3 * x, .acceleration = 3, .time_step = 1e-3};
    for (int n = 0; n < 4000; ++n) s.advance();
    EXPECT_NEAR(s.advance(), 3, 1e-9) << x;
    EXPECT_NEAR(s.slip, 3 / s.rate, 1e-9 * s.slip) << x;
  }
}

/// However stiff the drag, in every step.
TEST(DraggedSlip, StaysInBalanceWhenTheStepChanges) {
  for (const double x : {0.01, 1.0, 50.0})
    for (const double ratio : {0.5, 1.25, 2.0}) {
      DrivenSlip s{.rate = 1e3 * x, .acceleration = 3, .time_step = 1e-3};
      for (int n = 0; n < 4000; ++n) s.advance();
      for (int n = 0; n < 10; ++n) EXPECT_NEAR(s.advance(n == 1 ? ratio : 1), 3, 1e-9) << x << " " << ratio << " " << n;
    }
}

}  // namespace
}  // namespace lahar::coupling
