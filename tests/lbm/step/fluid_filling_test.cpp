// Liquid at the start.
#include <gtest/gtest.h>

#include <vector>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Boxes of liquid that stand on each other, or overlap, begin as the one that they make up.
TEST(FluidFilling, StackedBoxesAreOneBody) {
  const LiquidRegion whole{Vec3::Zero(), Vec3(0.2, 0.16, 0.35)}, lower{Vec3::Zero(), Vec3(0.2, 0.16, 0.2)},
      upper{Vec3(0, 0, 0.2), Vec3(0.2, 0.16, 0.35)}, beyond{Vec3(0, 0, 0.1), Vec3(0.2, 0.16, 0.35)};
  Fluid<double> one(tank_options(Vec3(0.8, 0.16, 0.5), 0.02, 3.0, 0.1));
  one.fill({whole});
  for (const auto& boxes :
       std::vector<std::vector<LiquidRegion>>{{lower, upper}, {upper, lower}, {lower, beyond}, {beyond, lower}}) {
    Fluid<double> some(tank_options(Vec3(0.8, 0.16, 0.5), 0.02, 3.0, 0.1));
    some.fill(boxes);
    EXPECT_NEAR(some.liquid_mass() / one.liquid_mass(), 1, 1e-12);
    std::vector<WetCell> cells;
    one.for_each_wet_cell([&](const WetCell& c) { cells.push_back(c); });
    for (const WetCell& c : cells) {
      const auto there = some.cell_at(c.centre);
      ASSERT_TRUE(there.has_value());
      EXPECT_NEAR(there->pressure, c.pressure, 1e-6);
    }
  }
}

/// What boxes share is filled once, in cells that they fill in part, too.
TEST(FluidFilling, WhatBoxesShareIsFilledOnce) {
  const LiquidRegion low{Vec3::Zero(), Vec3(0.41, 0.16, 0.205)}, across{Vec3(0.2, 0, 0), Vec3(0.6, 0.16, 0.213)},
      inside{Vec3(0.1, 0.01, 0.1), Vec3(0.3, 0.155, 0.207)};
  const double volume = 0.16 * (0.2 * 0.205 + 0.4 * 0.213) + 0.1 * 0.145 * 0.002;
  for (const auto& boxes : std::vector<std::vector<LiquidRegion>>{
           {low, across, inside}, {inside, low, across, low}, {across, inside, low}}) {
    auto options = tank_options(Vec3(0.8, 0.16, 0.5), 0.02, 3.0, 0.1);
    options.gravity = Vec3::Zero();  // no pressure that adds mass
    Fluid<double> fluid(options);
    fluid.fill(boxes);
    EXPECT_NEAR(fluid.liquid_mass() / options.density, volume, 1e-9);
  }
}

}  // namespace
}  // namespace lahar::lbm
