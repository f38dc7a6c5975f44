#include "coupling/wires/drag_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lahar::coupling {
namespace {

TEST(DragLaw, NormalDragFollowsExperiments) {
  EXPECT_NEAR(normal_drag_coefficient(1.0), 9.94, 0.01);  // cylinder_cd.csv
  EXPECT_NEAR(normal_drag_coefficient(100.0), 1.449, 0.001);
  EXPECT_NEAR(normal_drag_coefficient(1e4), 1.0945, 0.001);
}

TEST(DragLaw, ForceIsLinearInSlowFlow) {
  // Cd Re is constant below Re = 1e-4.
  EXPECT_NEAR(normal_drag_coefficient(1e-5) * 1e-5, normal_drag_coefficient(1e-4) * 1e-4, 1e-9);
}

/// The share of the inviscid disturbance that is left: against the integral that it comes from, and 1 without
/// viscosity.
TEST(DragLaw, OseenShareIsTheIntegral) {
  for (const double s : {0.2, 1.0, 5.9, 6.1, 50.0}) {
    double sum = 0;
    constexpr int n = 200000;
    for (int k = 0; k < n; ++k) {
      const double q = (k + 0.5) * 8 / n;
      sum += std::exp(-q * q) * (std::sqrt(1 + q * q / (s * s)) - q / s) * 8 / n;
    }
    EXPECT_NEAR(oseen_share(s), 2 * std::numbers::inv_sqrtpi * sum, 2e-4) << s;
  }
}

TEST(DragLaw, ScreenFactorStartsAtOneAndTurnsTheLossIntoThatOfBlevins) {
  EXPECT_EQ(screen_factor({}), 1);
  const double s = 0.3, a = 1 - s;  // K / (Cd/2) = (1 - a^2)/a^2
  EXPECT_NEAR(2 * s * screen_factor({.area = s, .parallel = s, .solidity = s}), (1 - a * a) / (a * a), 1e-12);
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
  WireInCells w{.diameter = 0.0061, .diameter_cells = 0.6, .kinematic_viscosity = 1e-6};
  for (const double cells : {0.1, 0.6, 2.0, 6.0})
    for (const double speed : {1e-4, 0.01, 2.0})
      for (const double area : {0.0, 0.3}) {
        w.diameter_cells = cells;
        w.screen = {.area = area, .parallel = area, .solidity = area};
        const double u = undisturbed_speed(speed, w);
        EXPECT_NEAR(u * (1 - self_induced_share(w, u)) / speed, 1, 1e-3) << cells << ' ' << speed << ' ' << area;
        EXPECT_GE(u, speed);
      }
}

/// Wires so close that the cells see a uniform resistance have no wake of their own to take out.
TEST(DragLaw, DenseScreenHasNoDeficitOfItsOwn) {
  const WireInCells w{.diameter = 0.0061,
                      .diameter_cells = 0.5,
                      .kinematic_viscosity = 1e-6,
                      .screen = {.area = 0.4, .parallel = 0.4, .solidity = 0.4}};
  EXPECT_EQ(undisturbed_speed(2.0, w), 2.0);
}

}  // namespace
}  // namespace lahar::coupling
