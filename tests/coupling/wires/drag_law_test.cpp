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
  // A mesh of solidity 0.4: its wires, 0.45 in all, share the loss.
  EXPECT_NEAR(2 * 0.45 * screen_factor({.area = 0.45, .parallel = 0.25, .solidity = 0.4}), (1 - 0.36) / 0.36, 1e-12);
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
  WireInCells w{.diameter = 0.0061, .diameter_cells = 0.6, .fluid = {1e-6}};
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
                      .fluid = {1e-6},
                      .screen = {.area = 0.4, .parallel = 0.4, .solidity = 0.4}};
  EXPECT_EQ(undisturbed_speed(2.0, w), 2.0);
}

/// What runs along a wire feels the fluid as the flow across it has thinned it, and the other way round.
TEST(DragLaw, FluidsThinByTheWholeVelocity) {
  const WireInCells w{.diameter = 0.0061, .diameter_cells = 0.6, .fluid = {0.01, 0.5, 0, 10}};
  const WireInCells thinned{.diameter = 0.0061, .diameter_cells = 0.6, .fluid = {0.01 / std::sqrt(1 / 0.0061)}};
  for (const double slow : {1e-2, 1e-4}) {
    const Vec3 x = Vec3::UnitX(), z = slow * Vec3::UnitZ();
    EXPECT_NEAR(viscous_drag(w, x, z).z() / viscous_drag(thinned, x, z).z(), 1, 1e-3) << slow;
    EXPECT_NEAR(viscous_drag(w, z, x).z() / viscous_drag(thinned, z, x).z(), 1, 1e-3) << slow;
    EXPECT_NEAR(self_induced_share(w, slow, 1) / self_induced_share(thinned, slow), 1, 1e-3) << slow;
  }
}

/// A wire in mud, m: yield stress 100 Pa and plastic viscosity 1 Pa s at 1800 kg/m^3.
WireInCells wire_in_mud() {
  return {.diameter = 0.03, .diameter_cells = 1.5, .fluid = {1 / 1800.0, 1, 100 / 1800.0, 1000}};
}

TEST(DragLaw, YieldStressAddsTheLimitOfAPlasticBodyToASlowWire) {
  const WireInCells w = wire_in_mud();
  const YieldDrag yield = yield_drag(w, 1e-3);  // Bn = 3000
  EXPECT_NEAR(yield.across / (w.fluid.yield_stress * w.diameter), 11.94, 0.2);
  EXPECT_NEAR(yield.along / (w.fluid.yield_stress * w.diameter), std::numbers::pi, 1e-9);
}

/// At rest mud is as viscous as its limit: what is slower than the creep speed feels less than the yield stress, about
/// what a Newtonian liquid of that viscosity would add.
TEST(DragLaw, YieldDragFadesAtRest) {
  const WireInCells w = wire_in_mud();
  const YieldDrag yield = yield_drag(w, 1e-9);
  EXPECT_NEAR(yield.across / yield.creep_speed / w.fluid.limit, 11.94, 0.2);
}

TEST(DragLaw, MudSlowsTheWireThatItsDragSlows) {
  const WireInCells w = wire_in_mud();
  for (const double speed : {1e-3, 0.1, 3.0}) {
    const double u = undisturbed_speed(speed, w);
    EXPECT_NEAR(u * (1 - self_induced_share(w, u)) / speed, 1, 1e-3) << speed;
  }
}

}  // namespace
}  // namespace lahar::coupling
