#include "core/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lahar {
namespace {

constexpr double eps = 8 * std::numeric_limits<double>::epsilon();

// Water at 10 mm cells and 0.5 ms: numbers worked out by hand.
const LatticeUnits water{0.01, 5e-4, 1000};

TEST(LatticeUnits, ConvertsAKnownCase) {
  EXPECT_NEAR(water.velocity_to_lu(2.0), 0.1, 0.1 * eps);
  EXPECT_NEAR(water.acceleration_to_lu(9.81), 2.4525e-4, 2.4525e-4 * eps);
  EXPECT_NEAR(water.viscosity_to_lu(1e-6), 5e-6, 5e-6 * eps);
  EXPECT_NEAR(water.mass(), 1e-3, 1e-3 * eps);
  EXPECT_NEAR(water.force_to_si(1.0), 40.0, 40 * eps);
  EXPECT_NEAR(water.torque_to_si(1.0), 0.4, 0.4 * eps);
  EXPECT_NEAR(water.pressure_to_si(1.0), 4e5, 4e5 * eps);
  const LatticeUnits drop{0.002, 1e-4, 1000};
  EXPECT_NEAR(drop.surface_tension_to_lu(0.0728), 9.1e-5, 9.1e-5 * eps);
}

TEST(LatticeUnits, RoundTripsReturnTheValue) {
  for (const double cell : {1e-3, 0.01, 0.37})
    for (const double step : {1e-6, 5e-4, 2.0})
      for (const double density : {1.0, 1000.0, 1850.0}) {
        const LatticeUnits u{cell, step, density};
        EXPECT_NEAR(u.velocity_to_si(u.velocity_to_lu(3.7)), 3.7, 3.7 * eps);
        EXPECT_NEAR(u.viscosity_to_si(u.viscosity_to_lu(1.3e-6)), 1.3e-6, 1.3e-6 * eps);
        EXPECT_NEAR(u.force_to_si(u.force_to_lu(-12.5)), -12.5, 12.5 * eps);
      }
}

// The Reynolds and Froude numbers have no unit: both sides must agree.
TEST(LatticeUnits, DimensionlessNumbersAreTheSameOnBothSides) {
  const LatticeUnits u{0.004, 3e-5, 1200};
  const double velocity = 1.7, length = 0.2, viscosity = 2e-5, gravity = 9.81;
  const double v = u.velocity_to_lu(velocity), n = length / u.cell_size;
  EXPECT_NEAR(v * n / u.viscosity_to_lu(viscosity), velocity * length / viscosity, 1e-9);
  EXPECT_NEAR(v / std::sqrt(u.acceleration_to_lu(gravity) * n), velocity / std::sqrt(gravity * length), 1e-12);
}

// Weight of a full cell: mass times gravity, computed on either side.
TEST(LatticeUnits, ForceIsMassTimesAcceleration) {
  const LatticeUnits u{0.02, 1e-4, 1000};
  const double weight_lu = 1.0 * u.acceleration_to_lu(9.81);
  EXPECT_NEAR(u.force_to_si(weight_lu), u.mass() * 9.81, 1e-12);
}

// A water column of n cells presses with rho g h at its foot.
TEST(LatticeUnits, PressureOfAWaterColumn) {
  const double column_lu = water.acceleration_to_lu(9.81) * 40;
  EXPECT_NEAR(water.pressure_to_si(column_lu), 1000 * 9.81 * 0.4, 1e-8);
}

}  // namespace
}  // namespace lahar
