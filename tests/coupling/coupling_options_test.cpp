#include "coupling/coupling_options.h"

#include <gtest/gtest.h>

namespace lahar::coupling {
namespace {

TEST(RadiusShift, GoesFromCreepingToFastFlow) {
  EXPECT_EQ(radius_shift_at(0), kRadiusShift);
  EXPECT_NEAR(radius_shift_at(2.5), (kRadiusShift + kRadiusShiftFast) / 2, 1e-15);
  EXPECT_NEAR(radius_shift_at(1e6), kRadiusShiftFast, 1e-6);
  for (double r = 0.01; r < 1e3; r *= 2) EXPECT_LT(radius_shift_at(2 * r), radius_shift_at(r)) << r;
}

}  // namespace
}  // namespace lahar::coupling
