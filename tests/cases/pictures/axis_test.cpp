#include "cases/pictures/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace lahar::cases {
namespace {

DataRange range(double low, double high, AxisScale scale = AxisScale::linear) {
  DataRange r(scale);
  r.include(low), r.include(high);
  return r;
}

void expect_values(const std::vector<double>& values, const std::vector<double>& wanted) {
  ASSERT_EQ(values.size(), wanted.size());
  for (std::size_t n = 0; n < values.size(); ++n) EXPECT_NEAR(values[n], wanted[n], 1e-9 * std::abs(wanted.back()));
}

TEST(Axis, LinearTicksAreRoundAndCoverTheData) {
  const AxisTicks ticks = ticks_of({}, range(-13, 71), 5);
  expect_values(ticks.major, {-20, 0, 20, 40, 60, 80});
  EXPECT_EQ(ticks.labels, (std::vector<std::string>{"-20", "0", "20", "40", "60", "80"}));
  EXPECT_EQ(ticks.low, -20);
  EXPECT_EQ(ticks.high, 80);
  EXPECT_EQ(ticks.minor.size(), 15U) << "a step of 2 has four parts";
  EXPECT_DOUBLE_EQ(ticks.share(30), 0.5);
  EXPECT_EQ(ticks_of({}, range(0, 0.37), 4).labels, (std::vector<std::string>{"0", "0.1", "0.2", "0.3", "0.4"}));
}

TEST(Axis, DoesNotShowAnEmptyStep) {
  const AxisTicks ticks = ticks_of({}, range(-0.02, 0.4), 5);
  expect_values(ticks.major, {0, 0.1, 0.2, 0.3, 0.4});
  EXPECT_LT(ticks.low, -0.02);
  EXPECT_GT(ticks.low, -0.06);
}

TEST(Axis, LargeAndSmallNumbersTakeAPowerOfThousandOut) {
  const AxisTicks large = ticks_of({.label = "force", .unit = "N"}, range(0, 31e3), 4);
  EXPECT_EQ(large.exponent, 3);
  EXPECT_EQ(large.labels, (std::vector<std::string>{"0", "10", "20", "30"}));
  EXPECT_EQ(axis_title({.label = "force", .unit = "N"}, large), "force (10^{3} N)");
  const AxisTicks small = ticks_of({}, range(0, 4e-5), 4);
  EXPECT_EQ(small.exponent, -6);
  EXPECT_EQ(small.labels.back(), "40");
  EXPECT_EQ(axis_title({.label = "error"}, small), "error (10^{-6})");
  EXPECT_EQ(axis_title({.label = "time", .unit = "s"}, ticks_of({}, range(0, 2), 4)), "time (s)");
}

TEST(Axis, LogarithmicTicksAreDecades) {
  const AxisTicks ticks = ticks_of({.scale = AxisScale::logarithmic}, range(3e-6, 0.5, AxisScale::logarithmic), 6);
  expect_values(ticks.major, {1e-5, 1e-4, 1e-3, 1e-2, 1e-1});
  EXPECT_EQ(ticks.labels.front(), "10^{-5}");
  EXPECT_LT(ticks.low, 3e-6);
  EXPECT_GT(ticks.high, 0.5);
  EXPECT_EQ(ticks.minor.size() + ticks.major.size(), 8U + 9 * 4 + 6) << "2e-6 to 6e-1";
  EXPECT_NEAR(ticks.share(std::sqrt(ticks.low * ticks.high)), 0.5, 1e-12);
}

TEST(Axis, ShortLogarithmicAxesNameTwoAndFive) {
  const AxisTicks ticks = ticks_of({.scale = AxisScale::logarithmic}, range(1.3, 40, AxisScale::logarithmic), 5);
  EXPECT_EQ(ticks.labels, (std::vector<std::string>{"1", "2", "5", "10", "20", "50"}));
  const AxisTicks long_one = ticks_of({.scale = AxisScale::logarithmic}, range(1e-9, 1e9, AxisScale::logarithmic), 5);
  EXPECT_LE(long_one.major.size(), 6U);
}

TEST(Axis, GivenEndsAreKept) {
  const AxisTicks ticks = ticks_of({.low = 0.13, .high = 0.88}, range(0, 5), 4);
  EXPECT_EQ(ticks.low, 0.13);
  EXPECT_EQ(ticks.high, 0.88);
  expect_values(ticks.major, {0.2, 0.4, 0.6, 0.8});
}

TEST(Axis, NumbersThatDifferByRoundingsAreOne) {
  for (const double value : {0.3, -4e5}) {
    DataRange data(AxisScale::linear);
    data.include(value), data.include(std::nextafter(value, 1e9));
    const AxisTicks ticks = ticks_of({}, data, 6);
    EXPECT_LT(ticks.major.size() + ticks.minor.size(), 100U);
    EXPECT_LT(ticks.low, value);
    EXPECT_GT(ticks.high, value);
  }
}

TEST(Axis, ConstantsNothingAndNonsenseGetARange) {
  for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic}) {
    const AxisTicks constant = ticks_of({.scale = scale}, range(7, 7, scale), 5);
    EXPECT_LT(constant.low, 7);
    EXPECT_GT(constant.high, 7);
    EXPECT_LT(ticks_of({.scale = scale}, DataRange(scale), 5).low,
              ticks_of({.scale = scale}, DataRange(scale), 5).high);
  }
  DataRange r(AxisScale::logarithmic);
  r.include(-1), r.include(std::numeric_limits<double>::quiet_NaN()), r.include(2);
  EXPECT_EQ(r.low, 2);
  EXPECT_THROW((void)ticks_of({.scale = AxisScale::logarithmic, .low = 0}, r, 5), std::logic_error);
}

}  // namespace
}  // namespace lahar::cases
