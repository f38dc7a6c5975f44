// Liquid at the start.
#include "lbm/step/fluid_filling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/shapes.h"
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

/// A box from z = 0 up, turned about z, as a body of sampled distances: half a cell between nodes, one of them at
/// `node`.
LiquidRegion sampled_box(const Vec3& middle, const Vec3& size, double angle, const Vec3& node, double cell_size) {
  const double reach = size.head<2>().norm() / 2;
  LiquidRegion region{middle - Vec3(reach, reach, 0), middle + Vec3(reach, reach, size.z())};
  const Eigen::AngleAxisd back(-angle, Vec3::UnitZ());
  const SolidBox box{Vec3(-size.x() / 2, -size.y() / 2, 0), Vec3(size.x() / 2, size.y() / 2, size.z())};
  const Vec3 margin = Vec3::Constant(4 * cell_size);
  const Vec3 first = node + cell_size / 2 * ((region.lower - margin - node) / (cell_size / 2)).array().floor().matrix();
  region.body = SampledDistance{sampled(first, region.upper + margin, cell_size / 2,
                                        [&](const Vec3& p) { return box.distance(back * (p - middle)); })};
  return region;
}

/// Where nodes lie on the edges of a body, between them its distance is half of what it should be: cells at an edge
/// that lies in the corner of a tank are whole all the same.
TEST(FluidFilling, EdgesOfABodyInTheCornersOfATankLeaveNoVoids) {
  constexpr double dx = 0.02, depth = 0.1;
  Fluid<double> fluid(tank_options(Vec3(0.16, 0.16, 0.3), dx, 3.0, 0.1));
  const LiquidRegion body = sampled_box(Vec3(0.08, 0.08, 0), Vec3(0.16, 0.16, depth), 0, Vec3::Zero(), dx);
  EXPECT_NEAR(std::get<SampledDistance>(*body.body).distance(Vec3(dx / 4, dx / 4, 2 * dx)), -dx / 8, 1e-6);
  fluid.fill({body});
  std::size_t below = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) {
    if (c.centre.z() > depth - dx) return;
    EXPECT_EQ(c.fill_level, 1) << c.centre.transpose();
    ++below;
  });
  EXPECT_EQ(below, 8u * 8u * 4u);
}

/// Under a lid there may be gas, in a layer of less than a cell, too.
TEST(FluidFilling, ABodyMayEndBelowALid) {
  constexpr double dx = 0.02;
  auto options = tank_options(Vec3(0.16, 0.16, 0.16), dx, 3.0, 0.1);
  options.domain.faces[5] = FaceKind::closed;
  options.gravity = Vec3::Zero();  // no pressure that adds mass
  Fluid<double> fluid(options);
  fluid.fill({sampled_box(Vec3(0.08, 0.08, 0), Vec3(0.16, 0.16, 0.156), 0, Vec3::Constant(dx / 4), dx)});
  EXPECT_NEAR(fluid.liquid_mass() / options.density, 0.16 * 0.16 * 0.156, 1e-4 * 0.16 * 0.16 * 0.156);
}

/// A body that ends at walls oblique to the lattice is at rest between them: no voids below, a level surface.
TEST(FluidFilling, ABodyBetweenObliqueWallsIsAtRest) {
  constexpr double dx = 0.02, depth = 0.2;
  const Vec3 middle(0.251, 0.247, 0), size(0.307, 0.243, depth);
  for (const double degrees : {0.0, 17.0, 30.0})
    for (const WallSlip slip : {WallSlip::no_slip, WallSlip::free_slip}) {
      const double angle = degrees * M_PI / 180;
      auto options = tank_options(Vec3(0.5, 0.5, 0.3), dx, 2.5, 0.1);
      options.domain.slip = slip;
      const Eigen::AngleAxisd turn(angle, Vec3::UnitZ());
      for (const Vec3& side : {Vec3(size.x() / 2, 0, 0), Vec3(0, size.y() / 2, 0)})
        for (const int sign : {-1, 1})
          options.domain.walls.add(
              {"side", HalfSpace{middle + sign * (turn * side), -sign * (turn * side.normalized())}, slip});
      Fluid<double> fluid(options);
      fluid.fill({sampled_box(middle, size, angle, Vec3::Constant(dx / 4), dx)});
      double wet = 0, volume = 0;
      fluid.for_each_wet_cell([&](const WetCell& c) {
        wet += dx * dx * dx, volume += c.liquid_volume;
        EXPECT_TRUE(c.fill_level == 1 || c.centre.z() > depth - dx) << degrees << ": " << c.centre.transpose();
      });
      EXPECT_NEAR(volume / wet, 1, 5e-3);  // cells that the walls cut are whole, at the surface nearly
      for (int k = 0; k < 100; ++k) fluid.step();
      EXPECT_LT(fluid.max_speed_lu(), 1e-3) << degrees;
    }
}

}  // namespace
}  // namespace lahar::lbm
