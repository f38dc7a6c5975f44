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

TEST(FastMath, lines_have_the_same_roots) {
  double worst = 0;
  const auto look = [&](double x) {
    const Line l = inverse_root(Line{x, 1.1 * x, 1.3 * x, 1.7 * x, 2.1 * x, 2.9 * x, 3.3 * x, 3.9 * x});
    const double factor[] = {1, 1.1, 1.3, 1.7, 2.1, 2.9, 3.3, 3.9};
    for (std::size_t k = 0; k < kLine; ++k) worst = std::max(worst, std::abs(l[k] * std::sqrt(factor[k] * x) - 1));
  };
  for (double x = 1e-300; x < 1e299; x *= 1.37) look(x);
  for (double x = 0.5; x < 4; x += 1e-4) look(x);
  EXPECT_LT(worst, 3 * std::numeric_limits<double>::epsilon());
  EXPECT_EQ(root(Line{})[3], 0);
}

TEST(FastMath, what_is_not_a_number_gives_way_to_the_second) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(smaller(none, 1.0), 1);
  EXPECT_EQ(larger(none, 1.0), 1);
  EXPECT_EQ(smaller(Line{none, 2}, Line{} + 1.0)[0], 1);
  EXPECT_EQ(larger(Line{none, 2}, Line{} + 1.0)[0], 1);
  EXPECT_EQ(larger(Line{none, 2}, Line{} + 1.0)[1], 2);
}

}  // namespace
}  // namespace lahar::dem
