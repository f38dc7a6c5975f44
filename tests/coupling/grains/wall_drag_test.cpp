#include "coupling/grains/wall_drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lbm/grid/velocity_set.h"

namespace lahar::coupling {
namespace {

/// The closed form against the sum over the lattice directions, averaged over many normals.
TEST(WallDrag, IsTheAverageOverAllNormals) {
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
    EXPECT_NEAR(wall_drag(q) / mean, 1, 2e-3) << q;
  }
}

TEST(WallDrag, EndsAtItsReachAndHoldsTheInterior) {
  EXPECT_EQ(wall_drag(kWallDragReach), 0);
  EXPECT_EQ(wall_drag(3.0F), 0);
  EXPECT_EQ(wall_drag(0.0), kInteriorDrag);
  EXPECT_EQ(wall_drag(-2.0), kInteriorDrag);
  EXPECT_GT(wall_drag(0.4), wall_drag(0.5));
}

TEST(WallDrag, JoiningDoesNotDependOnTheOrder) {
  const double gap = kGapDrag, one = 1, two = 0.3, three = 2.5;
  EXPECT_DOUBLE_EQ(joined_drag(one, one, gap), 6);  // the parabola in a gap of one cell
  EXPECT_DOUBLE_EQ(joined_drag(one, 0.0, gap), one);
  EXPECT_NEAR(joined_drag(joined_drag(one, two, gap), three, gap), joined_drag(one, joined_drag(two, three, gap), gap),
              1e-12);
  const double inside = kInteriorDrag;
  EXPECT_EQ(joined_drag(joined_drag(inside, inside, gap), inside, gap), inside);
  EXPECT_EQ(joined_drag(float(inside), float(inside), float(gap)), float(inside));
}

}  // namespace
}  // namespace lahar::coupling
