#include "coupling/grains/wall_resistance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lbm/grid/velocity_set.h"

namespace lahar::coupling {
namespace {

/// The closed form against the sum over the lattice directions, averaged over many normals.
TEST(WallResistance, IsTheAverageOverAllNormals) {
  using lbm::D3Q19;
  for (const double q : {0.05, 0.3, 0.7, 1.2}) {
    const int n = 20000;
    double mean = 0;
    for (int k = 0; k < n; ++k) {  // points of a Fibonacci lattice on the sphere
      const double z = 1 - (2 * k + 1.0) / n, r = std::sqrt(1 - z * z),
                   angle = std::numbers::pi * (3 - std::sqrt(5)) * k;
      const double normal[3] = {r * std::cos(angle), r * std::sin(angle), z};
      for (int i = 1; i < D3Q19::q; ++i) {
        double across = 0;
        for (int a = 0; a < 3; ++a) across += D3Q19::c[i][a] * normal[a];
        if (across < -q) mean += 6 / q * D3Q19::w(i) * (-across - q) / n;
      }
    }
    EXPECT_NEAR(wall_resistance(q) / mean, 1, 2e-3) << q;
  }
}

TEST(WallResistance, EndsAtItsReachAndHoldsTheInterior) {
  EXPECT_EQ(wall_resistance(kResistanceReach), 0);
  EXPECT_EQ(wall_resistance(3.0F), 0);
  EXPECT_EQ(wall_resistance(0.0), kInteriorResistance);
  EXPECT_EQ(wall_resistance(-2.0), kInteriorResistance);
  EXPECT_GT(wall_resistance(0.4), wall_resistance(0.5));
}

TEST(WallResistance, JoiningDoesNotDependOnTheOrder) {
  const double gap = kGapResistance, one = 1, two = 0.3, three = 2.5;
  EXPECT_DOUBLE_EQ(joined_resistance(one, one, gap), 6);  // the parabola in a gap of one cell
  EXPECT_DOUBLE_EQ(joined_resistance(one, 0.0, gap), one);
  EXPECT_NEAR(joined_resistance(joined_resistance(one, two, gap), three, gap),
              joined_resistance(one, joined_resistance(two, three, gap), gap), 1e-12);
  const double inside = kInteriorResistance;
  EXPECT_EQ(joined_resistance(joined_resistance(inside, inside, gap), inside, gap), inside);
  EXPECT_EQ(joined_resistance(float(inside), float(inside), float(gap)), float(inside));
}

}  // namespace
}  // namespace lahar::coupling
