#include "lbm/collision/stress_limit.h"

#include <gtest/gtest.h>

#include "lbm/collision/central_moments.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Populations at rest with a shear stress.
void sheared(double shear_stress, double (&f)[D3Q19::q]) {
  const double v[3] = {0.02, -0.01, 0.03};
  from_central_moments(0.01, v, Symmetric<double>{0, 0, 0, shear_stress, 0, 0}, f);
}

TEST(StressLimit, ResolvedFlowIsLeftAlone) {
  // A shear of 0.1 lu from one cell to the next: |D| = 0.1 / sqrt(2), |S| = 2/3 tau |D|.
  const double tau = 0.5;
  const Symmetric<double> s{0, 0, 0, tau / 3 * 0.1, 0, 0};
  EXPECT_EQ(limited_stress_share(s, 1.0, stress_limit(tau)), 1.0);
}

TEST(StressLimit, LargeStressIsCutToTheLimit) {
  const double limit = stress_limit(0.5);
  const Symmetric<double> s{0, 0, 0, 0.1, -0.05, 0};
  EXPECT_NEAR(limited_stress_share(s, 0.5, limit) * std::sqrt(square(s)) * 0.5, limit, 1e-15);
}

/// At tau = 1/2 the stress changes its sign; with a share it is that much smaller, with omega = 1 it is gone. Mass and
/// momentum are what they were.
TEST(StressLimit, TakesStressAloneOut) {
  struct Case {
    double rate, share, left;
  };
  for (const Case& c : {Case{2, 1, -1}, Case{2, 0.25, -0.25}, Case{1, 1, 0}}) {
    double f[D3Q19::q];
    sheared(0.01, f);
    const auto before = moments(f);
    const CellForcing<double> force{.acceleration = {0, 0, 0},
                                    .coverage_weight = 0,
                                    .solid_velocity = {0, 0, 0},
                                    .impulse = {0, 0, 0},
                                    .largest_rate = c.rate,
                                    .stress_share = c.share};
    CentralMoments::collide(f, before, force, Newtonian<double>{0.5});
    const auto after = moments(f);
    EXPECT_NEAR(stress(f, after).xy, c.left * 0.01, 1e-15);
    EXPECT_NEAR(after.drho, before.drho, 1e-15);
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(after.u[a], before.u[a], 1e-15);
  }
}

/// A step of 0.4 lu from one cell to the next is limited, one of 0.02 is not.
TEST(StressLimit, FluidCountsLimitedCells) {
  for (const double jump : {0.02, 0.4}) {
    Fluid<float> fluid(lattice_options({8, 8, 16}, 1e-6));
    fluid.fill_everything([&](const Vec3& p) { return Vec3((p.z() > 8 ? 0.5 : -0.5) * jump, 0, 0); }, no_pressure);
    for (int k = 0; k < 4; ++k) fluid.step();
    EXPECT_EQ(fluid.account().limited > 0, jump > 0.1) << jump;
  }
}

/// Cells of the surface of resting water touch liquid and are not bounded; all of a falling drop of eight cells are.
TEST(StressLimit, OnlySprayIsExposed) {
  Fluid<double> tank(tank_options(Vec3(0.16, 0.16, 0.2), 0.01, 2.0));
  tank.fill({{Vec3::Zero(), Vec3(0.16, 0.16, 0.105)}});
  tank.step();
  EXPECT_EQ(tank.account().exposed, 0);
  EXPECT_EQ(tank.account().limited, 0);
  Fluid<double> drop(tank_options(Vec3(0.16, 0.16, 0.2), 0.01, 2.0));
  drop.fill({{Vec3(0.08, 0.08, 0.1), Vec3(0.1, 0.1, 0.12)}});
  drop.step();
  EXPECT_EQ(drop.account().exposed, 8);
}

}  // namespace
}  // namespace lahar::lbm
