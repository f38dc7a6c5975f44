// Limits of the coverage weight: what each weighting gives, and how the exchange grows with the slip.
#include "lbm/collision/coverage_weight.h"

#include <gtest/gtest.h>

namespace lahar::lbm {
namespace {

constexpr double kCovered = 1e12;  // drag of a cell in a body

CoverageWeights<double> weights(BodyWeighting weighting, double viscosity) {
  return CoverageWeights<double>(coverage_weight_law(weighting, 0.5 + 3 * viscosity));
}

/// Momentum per density that a cell gives in a step.
double exchange(double viscosity, double fraction, double slip) {
  return slip * weights(BodyWeighting::inertial, viscosity).of(kCovered, fraction, slip);
}

TEST(CoverageWeight, OfTheSolidFractionKnowsNoSlip) {
  for (const double slip : {0.0, 1e-4, 0.1}) {
    EXPECT_DOUBLE_EQ(weights(BodyWeighting::solid_fraction, 0.01).of(0.3, 0.3, slip), 0.3);
    const double t = 3 * 0.01;  // tau - 1/2
    EXPECT_NEAR(weights(BodyWeighting::noble_torczynski, 0.01).of(0.3, 0.3, slip), 0.3 * t / (0.7 + t), 1e-14);
  }
}

TEST(CoverageWeight, BodiesAreRigidInSlowFlow) {
  for (const double viscosity : {1e-3, 0.1}) {
    const auto law = coverage_weight_law(BodyWeighting::inertial, 0.5 + 3 * viscosity);
    EXPECT_EQ(CoverageWeights<double>(law).of(kCovered, 1, 0), law.largest);
    const auto rigid = coverage_weight_law(BodyWeighting::wall_distance, 0.5 + 3 * viscosity);
    EXPECT_EQ(CoverageWeights<double>(rigid).of(kCovered, 1, 0.1), rigid.largest);
  }
}

/// Beside a surface the drag is that of the wall's distance, whatever the slip.
TEST(CoverageWeight, OpenCellsFeelTheWallAlone) {
  for (const double slip : {1e-6, 1e-3, 0.1}) {
    const double k = 0.02 * 1.5;
    for (const auto weighting : {BodyWeighting::wall_distance, BodyWeighting::inertial})
      EXPECT_NEAR(weights(weighting, 0.02).of(1.5, 0, slip), k / (1 + k / 2), 1e-14);
  }
}

TEST(CoverageWeight, FastFlowIsHeldByTheSquareOfTheSlip) {
  const double viscosity = 1e-7, slip = 1e-3;
  EXPECT_NEAR(exchange(viscosity, 1, slip), kInertialDrag * slip * slip, 0.02 * kInertialDrag * slip * slip);
  EXPECT_NEAR(exchange(viscosity, 1, slip) / exchange(viscosity, 1, slip / 2), 4, 0.05);
  EXPECT_NEAR(exchange(viscosity, 0.5, slip) / exchange(viscosity, 1, slip), 0.125, 0.01);
}

/// The same flow with half the time step: velocities and viscosity are half as large, a step gives a quarter as much.
TEST(CoverageWeight, TheTimeStepDoesNotMatterWhereStepsAreShort) {
  for (const double viscosity : {1e-6, 1e-4})
    EXPECT_NEAR(exchange(viscosity, 1, 5e-4) / exchange(viscosity / 2, 1, 2.5e-4), 4, 0.05);
}

TEST(CoverageWeight, BodiesThatOverlapCountOnce) { EXPECT_EQ(exchange(1e-6, 1.7, 1e-3), exchange(1e-6, 1, 1e-3)); }

}  // namespace
}  // namespace lahar::lbm
