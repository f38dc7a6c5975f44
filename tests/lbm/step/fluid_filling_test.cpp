// Liquid at the start.
#include "lbm/step/fluid_filling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

/// What falls freely has no pressure: blocks in the air, a column over an open floor, a channel without ends, also with
/// a sill in it.
TEST(FluidFilling, LiquidThatNothingBearsHasNoPressure) {
  const FluidOptions tank = tank_options(Vec3(0.16, 0.16, 0.64), 0.02, 3.0, 0.1);
  FluidOptions shaft = tank, endless = tank;
  shaft.domain.faces[4] = FaceKind::open;
  endless.domain.faces[4] = endless.domain.faces[5] = FaceKind::periodic;
  FluidOptions with_sill = endless;
  with_sill.domain.walls.add({"sill", SolidBox{Vec3(0.04, 0, 0.2), Vec3(0.12, 0.16, 0.3)}});
  const LiquidRegion all{Vec3::Zero(), tank.domain.upper}, column{Vec3::Zero(), Vec3(0.16, 0.16, 0.4)},
      block{Vec3(0.04, 0.04, 0.2), Vec3(0.12, 0.12, 0.3)}, above{Vec3(0.04, 0.04, 0.3), Vec3(0.12, 0.12, 0.5)};
  LiquidRegion drop{Vec3(0.03, 0.03, 0.35), Vec3(0.13, 0.13, 0.45)};
  drop.body = SolidSphere{Vec3(0.08, 0.08, 0.4), 0.05};
  struct Falling {
    FluidOptions options;
    std::vector<LiquidRegion> regions;
  };
  for (const Falling& f : {Falling{endless, {all}}, Falling{with_sill, {all}}, Falling{shaft, {column}},
                           Falling{tank, {block}}, Falling{tank, {block, above}}, Falling{tank, {drop}}}) {
    Fluid<double> fluid(f.options);
    fluid.fill(f.regions);
    double volume = 0, pressure = 0;
    fluid.for_each_wet_cell(
        [&](const WetCell& c) { volume += c.liquid_volume, pressure = std::max(pressure, std::abs(c.pressure)); });
    EXPECT_NEAR(fluid.liquid_mass() / (tank.density * volume), 1, 1e-12);
    EXPECT_LT(pressure, 1e-6);
  }
}

/// A pool on the floor bears its own weight, and not that of a block above it.
TEST(FluidFilling, LiquidOnTheFloorBearsItsWeight) {
  constexpr double depth = 0.2;
  Fluid<double> fluid(tank_options(Vec3(0.16, 0.16, 0.64), 0.02, 3.0, 0.1));
  fluid.fill({{Vec3::Zero(), Vec3(0.16, 0.16, depth)}, {Vec3(0.04, 0.04, 0.3), Vec3(0.12, 0.12, 0.5)}});
  fluid.for_each_wet_cell([&](const WetCell& c) {
    EXPECT_NEAR(c.pressure, 9810 * std::max(0.0, depth - c.centre.z()), 0.01 * 9810 * depth) << c.centre.z();
  });
}

/// On a floor, a ledge or a slope, or beside what stands there; not over a gap, nor what stands on that.
TEST(FluidFilling, WallsBearWhatStandsOnThem) {
  DomainSpec s;
  s.upper = Vec3(0.64, 0.16, 0.64);
  s.cell_size = 0.02;
  s.walls.add({"ledge", SolidBox{Vec3(0, 0, 0.3), Vec3(0.1, 0.16, 0.32)}});
  s.walls.add({"slope", HalfSpace{Vec3(0.3, 0, 0.02), Vec3(-0.5, 0, 1).normalized()}});
  const std::vector<LiquidRegion> regions{{Vec3(0, 0, 0.01), Vec3(0.1, 0.16, 0.1)},       // half a cell above the floor
                                          {Vec3(0.06, 0, 0.36), Vec3(0.16, 0.16, 0.4)},   // beside the next one
                                          {Vec3(0, 0, 0.32), Vec3(0.06, 0.16, 0.4)},      // on the ledge
                                          {Vec3(0.5, 0, 0.05), Vec3(0.6, 0.16, 0.3)},     // on the slope, and into it
                                          {Vec3(0.12, 0, 0.02), Vec3(0.2, 0.16, 0.1)},    // a cell above the floor
                                          {Vec3(0.3, 0.04, 0.4), Vec3(0.4, 0.12, 0.5)},   // in the air
                                          {Vec3(0.3, 0.04, 0.5), Vec3(0.35, 0.1, 0.6)}};  // on that
  EXPECT_EQ(borne_regions(Domain(s), regions), std::vector<bool>({true, true, true, true, false, false, false}));
  s.faces[4] = s.faces[5] = FaceKind::periodic;
  EXPECT_EQ(borne_regions(Domain(s), regions), std::vector<bool>(regions.size(), false));
}

}  // namespace
}  // namespace lahar::lbm
