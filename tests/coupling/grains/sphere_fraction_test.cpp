#include "coupling/grains/sphere_fraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "coupling/grains/sphere_rows.h"

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
        store(row, fraction_row(s, x, y, z));
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

/// No cell that a sphere covers lies in a row that is left out, and few rows are taken in vain.
TEST(SphereFraction, RowsNearASphereHoldAllOfIt) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> offset(-2, 10);
  int taken = 0, needed = 0;
  for (int k = 0; k < 300; ++k) {
    GridSphere<float> s{};
    for (float& c : s.centre) c = static_cast<float>(16 + offset(random));
    s.radius = k % 2 ? 2.0F : 0.6F;
    s.surface = -2;
    const Vec3i lowest(16, 16, 16);
    bool seen[8][8] = {};
    for_rows_near(s, lowest, covered_reach(s), [&](int y, int z) { seen[y][z] = true; });
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z) {
        float row[8];
        store(row, fraction_row(s, 16, 16 + y, 16 + z));
        const bool covered = *std::max_element(row, row + 8) > 0;
        EXPECT_TRUE(seen[y][z] || !covered) << k;
        taken += seen[y][z], needed += covered;
      }
  }
  EXPECT_GT(needed, 1000);
  EXPECT_LT(taken, 1.05 * needed);  // a row may come near the sphere between two of its cells (2 % here)
}

}  // namespace
}  // namespace lahar::coupling
