#include "coupling/grains/seepage.h"

#include <gtest/gtest.h>

#include "lbm/step/sweep.h"

namespace lahar::coupling {
namespace {

TEST(Seepage, ErgunVelocitySolvesItsEquation) {
  const double d = 0.05, nu = 1e-6, g = 9.81, v = ergun_velocity(d, nu, g), e = 0.36, s = 0.64;
  EXPECT_NEAR(150 * nu * s * s / (e * e * e * d * d) * v + 1.75 * s / (e * e * e * d) * v * v, g, 1e-9);
  EXPECT_NEAR(v, 0.14, 0.02);  // gravel of 5 cm
}

TEST(Seepage, SmallGrainsFollowDarcy) {
  const double v1 = ergun_velocity(1e-4, 1e-6, 9.81), v2 = ergun_velocity(1e-4, 2e-6, 9.81);
  EXPECT_NEAR(v1 / v2, 2, 1e-2);
}

/// In uniform cells at rest the coverage weight of this constant lets Ergun's velocity through.
TEST(Seepage, ConstantReproducesTheVelocity) {
  const LatticeUnits units{0.02, 2e-4, 1000};
  const double c = seepage_constant(0.06, 1e-6, 9.81, units);
  const double b = lbm::coverage_weight(kPackedSolidFraction,
                                        lbm::coverage_weight_law(lbm::BodyWeighting::seepage, 1, c)),
               a = units.acceleration_to_lu(9.81);
  double v = 0;
  for (int step = 0; step < 5000; ++step) v = (1 - b) * (v + a);
  EXPECT_NEAR(units.velocity_to_si(v) / ergun_velocity(0.06, 1e-6, 9.81), 1, 0.02);
}

}  // namespace
}  // namespace lahar::coupling
