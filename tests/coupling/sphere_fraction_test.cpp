#include "coupling/sphere_fraction.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace lahar::coupling {
namespace {

double covered_volume(double radius, const Vec3& offset) {
  GridSphere<double> s{};
  for (int a = 0; a < 3; ++a) s.centre[a] = 20 + offset[a];
  s.radius = mapping_radius(radius);
  s.factor = 1;
  double sum = 0, row[8];
  for (int x = 0; x < 40; x += 8)
    for (int y = 0; y < 40; ++y)
      for (int z = 0; z < 40; ++z) {
        sphere_row(s, x, y, z, row);
        for (const double e : row) {
          EXPECT_GE(e, 0);
          EXPECT_LE(e, 1);
          sum += e;
        }
      }
  return sum;
}

TEST(SphereFraction, MappingRadiusSolvesItsEquation) {
  for (const double r : {0.7, 1.0, 2.0, 10.0}) {
    const double m = mapping_radius(r);
    EXPECT_NEAR(m * m * m + m / 4, r * r * r, 1e-9 * r * r * r);
  }
  EXPECT_DOUBLE_EQ(mapping_radius(0.1), 0.5);
}

/// Volume error over random offsets: mean nearly zero, at most 1 % rms from 4 cells a diameter on.
TEST(SphereFraction, VolumeIsRightWithoutCorrection) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> offset(-0.5, 0.5);
  for (const double radius : {2.0, 4.0, 8.0}) {
    const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
    double mean = 0, square = 0;
    for (int k = 0; k < 60; ++k) {
      const double error = covered_volume(radius, {offset(random), offset(random), offset(random)}) / exact - 1;
      mean += error / 60;
      square += error * error / 60;
    }
    EXPECT_LT(std::abs(mean), 0.005) << radius;
    EXPECT_LT(std::sqrt(square), 0.01) << radius;
  }
}

TEST(SphereFraction, RowsInReachCoverTheSphere) {
  GridSphere<double> s{};
  s.centre[0] = 4.0, s.centre[1] = 7.9, s.centre[2] = 3.0;
  s.radius = 2.0;
  const RowRange here = rows_in_reach(s, Vec3i(0, 0, 0), 2.5), next = rows_in_reach(s, Vec3i(0, 8, 0), 2.5);
  EXPECT_EQ(here.low[0], 5);
  EXPECT_EQ(here.high[0], 8);
  EXPECT_EQ(next.low[0], 0);
  EXPECT_EQ(next.high[0], 3);
}

}  // namespace
}  // namespace lahar::coupling
