#include "coupling/drag_law.h"

#include <gtest/gtest.h>

namespace lahar::coupling {
namespace {

TEST(DragLaw, NormalDragFollowsExperiments) {
  EXPECT_NEAR(normal_drag_coefficient(1.0), 11, 1.5);      // Tritton 1959: about 10
  EXPECT_NEAR(normal_drag_coefficient(100.0), 1.46, 0.1);  // about 1.4
  EXPECT_NEAR(normal_drag_coefficient(1e4), 1.02, 0.1);    // about 1.1
}

TEST(DragLaw, ForceIsLinearInSlowFlow) {
  // Cd Re is constant below Re = 0.1.
  EXPECT_NEAR(normal_drag_coefficient(0.01) * 0.01, normal_drag_coefficient(0.05) * 0.05, 1e-12);
}

TEST(DragLaw, KernelIsAPartitionWithConstantSquares) {
  for (double offset = -0.5; offset <= 0.5; offset += 0.05) {
    double sum = 0, squares = 0, first = 0;
    for (int cell = -3; cell <= 3; ++cell) {
      const double w = roma_kernel(cell - offset);
      sum += w, squares += w * w, first += w * (cell - offset);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(first, 0, 1e-12);
    EXPECT_NEAR(squares, kRomaSquares, 1e-12);
  }
}

TEST(DragLaw, UndisturbedSpeedInvertsTheDeficit) {
  const double d = 0.0061, nu = 1e-6, cells = 0.6, u = undisturbed_speed(2.0, d, nu, cells);
  const double cd = normal_drag_coefficient(u * d / nu);
  EXPECT_NEAR(u * (1 - cd * cells * kRomaSquares / 4), 2.0, 1e-3);
  EXPECT_GT(u, 2.0);
}

}  // namespace
}  // namespace lahar::coupling
