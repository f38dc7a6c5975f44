// Drag on slow spheres and cylinders in mud, against its limits.
#include "coupling/yield_drag.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lahar::coupling {
namespace {

/// A sphere sinks where its weight in the mud is above 2 pi R^2 yield / 0.143 (Beris et al. 1985).
TEST(YieldDrag, SphereThatHardlySinks) {
  const double bn = 1e6, stokes = 3 * std::numbers::pi;  // mu = D = u = 1, yield = Bn
  const double limit = 2 * std::numbers::pi * 0.25 * bn / 0.143;
  EXPECT_NEAR(stokes * sphere_yield_factor(bn) / limit, 1, 0.01);
  EXPECT_EQ(sphere_yield_factor(0), 1);
}

/// The fields that make the dissipation least, as printed by drag_in_mud_reference.py.
TEST(YieldDrag, IsThatOfTheLeastDissipation) {
  EXPECT_NEAR(sphere_yield_factor(1), 3.995, 0.04);
  EXPECT_NEAR(sphere_yield_factor(10), 18.04, 0.18);
  EXPECT_NEAR(sphere_yield_factor(100), 133.4, 1.3);
  EXPECT_NEAR(10 * cylinder_yield_coefficient(10), 162.7 - 2, 2);
  EXPECT_NEAR(100 * cylinder_yield_coefficient(100), 1304 - 2, 13);
}

/// Randolph & Houlsby 1984.
TEST(YieldDrag, CylinderInAPlasticBody) {
  EXPECT_NEAR(cylinder_yield_coefficient(1e9), 2 * std::numbers::pi + 4 * std::numbers::sqrt2, 0.01);
}

TEST(YieldDrag, WaterIsWater) {
  const lbm::ShearLaw water = lbm::shear_law({}, 1e-6, 1000);
  EXPECT_EQ(viscosity_past_sphere(water, 0.1, 2), 1e-6);
}

/// Bingham with a small grain in it: what holds it up is the yield stress, until the limit viscosity takes over.
TEST(YieldDrag, MudIsNoMoreViscousThanItsLimit) {
  const lbm::ShearLaw mud = lbm::shear_law({lbm::FlowLaw::bingham, 100, 0, 1, 10}, 1e-3, 1000);
  EXPECT_NEAR(viscosity_past_sphere(mud, 0.1, 0.1), 0.1334, 0.001);  // Bn = 100
  EXPECT_EQ(viscosity_past_sphere(mud, 0.1, 1e-9), 10);
}

}  // namespace
}  // namespace lahar::coupling
