#include "dem/fast_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lahar::dem {
namespace {

TEST(FastMath, inverse_root_is_right_to_two_units_in_the_last_place) {
  double worst = 0;
  for (double x = 1e-300; x < 1e300; x *= 1.37) worst = std::max(worst, std::abs(inverse_root(x) * std::sqrt(x) - 1));
  for (double x = 0.5; x < 4; x += 1e-4) worst = std::max(worst, std::abs(inverse_root(x) * std::sqrt(x) - 1));
  EXPECT_LT(worst, 3 * std::numeric_limits<double>::epsilon());  // two, and one for the check's own roundings
}

TEST(FastMath, root_of_zero_is_zero) {
  EXPECT_TRUE(std::isfinite(inverse_root(0)));
  EXPECT_EQ(0.0 * inverse_root(0), 0);
}

}  // namespace
}  // namespace lahar::dem
