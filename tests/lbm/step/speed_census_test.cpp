#include "lbm/step/speed_census.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lbm/step/cell_moments.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

constexpr double kClass = 0.0225;  // width of a class of speeds over the speed

TEST(Census, FindsWhatAShareExceeds) {
  Census census;
  EXPECT_EQ(census.exceeded_by(0.1), 0);
  for (int k = 1; k <= 1000; ++k) census.add(1e-8F * static_cast<float>(k * k));  // speeds of 1e-4 k
  EXPECT_EQ(census.cells(), 1000);
  for (const double share : {0.0, 0.001, 0.01, 0.1, 0.5}) {
    const double exact = 0.1 * (1 - share), found = census.exceeded_by(share);
    EXPECT_GE(found, exact * (1 - 1e-6)) << share;
    EXPECT_LE(found, exact * (1 + 2 * kClass)) << share;
  }
}

TEST(Census, TakesWhatIsNoSpeedAsTheLargest) {
  Census census;
  census.add(0);
  EXPECT_LE(census.exceeded_by(0), 2.6e-4);
  for (const float square : {4.0F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    Census one = census;
    one.add(square);
    EXPECT_EQ(one.exceeded_by(0), 1.0) << square;
    EXPECT_LE(one.exceeded_by(0.5), 2.6e-4) << square;
  }
}

template <class Real>
class SpeedCensusOf : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(SpeedCensusOf, Reals);

/// A column of liquid, in a box with dry cells and walls.
FluidOptions column() {
  FluidOptions o;
  o.domain.cell_size = 0.01;
  o.domain.upper = Vec3(0.40, 0.08, 0.24);
  o.time_step = 4e-4;
  o.gravity = Vec3(0, 0, -9.81);
  return o;
}

TYPED_TEST(SpeedCensusOf, CountsEveryWetCellByItsSpeed) {
  Fluid<TypeParam> fluid(column());
  fluid.fill({{Vec3(0, 0, 0), Vec3(0.13, 0.08, 0.2)}});
  for (int s = 0; s < 250; ++s) fluid.step();
  std::vector<double> speeds, reaches;
  for (const BlockIndex b : fluid.grid().owned())
    for (int n = 0; n < kBlockCells; ++n) {
      if (!is_wet(fluid.grid().type({b, n}))) continue;
      const auto m = outgoing_moments(fluid.grid(), {b, n}, fluid.parity());
      const auto square = static_cast<double>(m.u[0] * m.u[0] + m.u[1] * m.u[1] + m.u[2] * m.u[2]);
      speeds.push_back(std::sqrt(square));
      reaches.push_back(std::sqrt(std::max(square, 2.0 / 3.0 * std::abs(static_cast<double>(m.drho)))));
    }
  std::sort(speeds.rbegin(), speeds.rend());
  std::sort(reaches.rbegin(), reaches.rend());
  ASSERT_GT(speeds.size(), 1000u);
  ASSERT_GT(speeds.front(), 1.1 * speeds[speeds.size() / 50]);  // the share matters
  const SpeedCensus census = take_speed_census(fluid.grid(), fluid.parity());
  EXPECT_EQ(census.speed.cells(), static_cast<std::int64_t>(speeds.size()));
  for (const double share : {0.0, 0.001, 0.02, 0.3}) {
    const auto spared = static_cast<std::size_t>(share * static_cast<double>(speeds.size()));
    const auto near = [&](double found, double exact) {
      EXPECT_GE(found, exact * (1 - 1e-6)) << share;
      EXPECT_LE(found, exact * (1 + 2 * kClass)) << share;
    };
    near(census.speed.exceeded_by(share), speeds[spared]);
    near(census.reach.exceeded_by(share), reaches[spared]);
  }
}

}  // namespace
}  // namespace lahar::lbm
