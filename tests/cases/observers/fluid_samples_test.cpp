#include "cases/observers/fluid_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/assembly/build.h"
#include "tests/cases/observers/tank_with_ball.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

/// Hydrostatic pressure in the water, at a wall of the domain, on the floor (that of the lowest cells, half a cell
/// higher up), at a sphere between the cells; none in the air.
TEST(FluidSamples, PressureInsideAndAtWalls) {
  const scene::Scene scene = scene::load_text(tank_with_ball);
  lbm::Fluid<double> fluid(fluid_options(scene));
  const auto view = view_of(fluid);
  fluid.fill(liquid_regions(scene));
  for (int s = 0; s < 300; ++s) fluid.step();
  const auto depth = [&](const Vec3& p) { return pressure_at(*view, p) / (1000 * 9.81); };
  constexpr double half_cell = 0.005;  // the level is felt within half a cell
  EXPECT_NEAR(depth({0.05, 0.05, 0.153}), 0.147, half_cell);
  EXPECT_NEAR(depth({0.05, 0.05, 0.153}) - depth({0.05, 0.05, 0.193}), 0.04, 0.001);
  EXPECT_NEAR(depth({0, 0.08, 0.107}), 0.193, half_cell);
  EXPECT_NEAR(depth({-0.003, 0.08, 0.107}), 0.193, half_cell);
  EXPECT_NEAR(depth({0.05, 0.05, 0}), 0.3 - half_cell, half_cell);
  EXPECT_NEAR(depth({0.21, 0.08, 0.1}), 0.2, half_cell);
  EXPECT_EQ(depth({0.05, 0.05, 0.35}), 0);
  EXPECT_EQ(depth({0, 0.05, 0.35}), 0);
  EXPECT_NEAR(depth_over(*view, Vec3(0.05, 0.05, 0), 0.4), 0.3, 1e-3);
  for (const Vec3& at_the_end : {Vec3(0, 0.05, 0), Vec3(0.32, 0.05, 0), Vec3(0.05, 0, 0), Vec3(0.05, 0.16, 0)})
    EXPECT_NEAR(depth_over(*view, at_the_end, 0.4), 0.3, 1e-3) << at_the_end;
}

/// The last cells of a domain of no whole cells may lie in its wall: a point on that is over the last but one.
TEST(FluidSamples, DepthAtTheEndOfNoWholeCells) {
  for (const char* upper : {"[0.323, 0.163, 0.4]", "[0.327, 0.167, 0.4]"}) {
    const scene::Scene scene =
        scene::load_text(tank_of_water, {std::string("domain.upper_m=") + upper,
                                         std::string("fluid.region[0].upper_m=") + std::string(upper, 14) + "0.3]"});
    lbm::Fluid<double> fluid(fluid_options(scene));
    const auto view = view_of(fluid);
    fluid.fill(liquid_regions(scene));
    const Vec3 end = scene.domain.upper;
    for (const Vec3& p : {Vec3(end.x(), 0.05, 0), Vec3(0.05, end.y(), 0), Vec3(end.x(), end.y(), 0)})
      EXPECT_NEAR(depth_over(*view, p, 0.4), 0.3, 1e-3) << p;
  }
}

/// A floor of a box that ends at periodic faces goes on beyond them.
TEST(FluidSamples, OverAFloorThatEndsAtPeriodicFaces) {
  const scene::Scene scene = scene::load_text(R"([scene]
name = "endless"
[run]
duration_s = 0.1
precision = "double"
[domain]
lower_m = [0, 0, 0]
upper_m = [0.16, 0.16, 0.32]
open_faces = ["z+"]
periodic_axes = ["x", "y"]
[fluid]
enabled = true
cell_size_m = 0.02
[[fluid.region]]
lower_m = [0, 0, 0]
upper_m = [0.16, 0.16, 0.2]
[[wall]]
name = "floor"
shape = "box"
lower_m = [0, 0, 0]
upper_m = [0.16, 0.16, 0.055]
)");
  lbm::Fluid<double> fluid(fluid_options(scene));
  const auto view = view_of(fluid);
  fluid.fill(liquid_regions(scene));
  const double pressure = pressure_at(*view, Vec3(0.08, 0.08, 0.055));
  EXPECT_NEAR(pressure, 9810 * 0.13, 0.01 * 9810 * 0.13);  // of the lowest cells
  EXPECT_NEAR(depth_over(*view, Vec3(0.08, 0.08, 0), 0.32), 0.14, 1e-9);
  for (const double x : {0.0, 0.001, 0.08, 0.159, 0.16})
    for (const double y : {0.001, 0.16}) {
      EXPECT_NEAR(pressure_at(*view, Vec3(x, y, 0.055)) / pressure, 1, 1e-9) << x << " " << y;
      EXPECT_NEAR(depth_over(*view, Vec3(x, y, 0), 0.32), 0.14, 1e-9) << x << " " << y;
    }
}

/// A drop in the air is no depth; a bubble of one cell does not end the water.
TEST(FluidSamples, DepthWithoutDrops) {
  const scene::Scene scene = scene::load_text(tank_with_ball);
  lbm::Fluid<double> fluid(fluid_options(scene));
  const auto view = view_of(fluid);
  const auto slab = [](double from, double to) { return lbm::LiquidRegion{Vec3(0, 0, from), Vec3(0.32, 0.16, to)}; };
  fluid.fill({slab(0, 0.10), slab(0.11, 0.20), slab(0.30, 0.32)});
  EXPECT_NEAR(depth_over(*view, Vec3(0.035, 0.035, 0), 0.4), 0.19, 1e-6);
  EXPECT_NEAR(depth_over(*view, Vec3(0.035, 0.035, 0.25), 0.4), 0, 1e-6);
  // From within the ground: here the ball, over which the second slab goes on.
  EXPECT_NEAR(depth_over(*view, Vec3(0.165, 0.085, 0.10), 0.4), depth_over(*view, Vec3(0.165, 0.085, 0.15), 0.4), 1e-6);
  EXPECT_GT(depth_over(*view, Vec3(0.165, 0.085, 0.10), 0.4), 0.03);
}

/// Points level with the centres of cells lie between two samples that are faces: each cell counts once all the same.
TEST(FluidSamples, DepthOverPointsAmidCells) {
  constexpr double dx = 0.025;
  const scene::Scene scene =
      scene::load_text(tank_of_water, {"domain.lower_m=[0, 0, -0.05]", "domain.upper_m=[0.325, 0.175, 0.4]",
                                       "fluid.cell_size_m=0.025", "fluid.region[0].lower_m=[0, 0, -0.05]"});
  lbm::Fluid<double> fluid(fluid_options(scene));
  const auto view = view_of(fluid);
  fluid.fill(liquid_regions(scene));
  const auto depth = [&](int k) { return depth_over(*view, Vec3(0.06, 0.06, -0.05 + (k + 0.5) * dx), 0.4); };
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(depth(k) - depth(k + 1), dx, 1e-9) << k;
}

/// Pressure is linear in the depth: its mean over a disc in a side wall is that of its centre, but where part of it is
/// in the air. On the floor every place has the same.
TEST(FluidSamples, PressureOnADisc) {
  const scene::Scene scene = scene::load_text(tank_with_ball);
  lbm::Fluid<double> fluid(fluid_options(scene));
  const auto view = view_of(fluid);
  fluid.fill(liquid_regions(scene));
  for (int s = 0; s < 300; ++s) fluid.step();
  const Vec3 side(0, 0.08, 0.107), floor(0.05, 0.05, 0), rim(0, 0.08, 0.3);
  EXPECT_EQ(pressure_on_disc(*view, side, 0), pressure_at(*view, side));
  EXPECT_NEAR(pressure_on_disc(*view, side, 0.04) / pressure_at(*view, side), 1, 0.01);
  EXPECT_NEAR(pressure_on_disc(*view, floor, 0.03) / pressure_at(*view, floor), 1, 0.01);
  // Half of the disc is wet: 4/3 r^3 / 2 of first moment over its area, 2 r / (3 pi) of depth.
  const double depth = pressure_on_disc(*view, rim, 0.1) / (1000 * 9.81);
  EXPECT_NEAR(depth, 2 * 0.05 / (3 * std::numbers::pi), 0.004);
}

/// Linear between centres, and of wet cells alone.
TEST(FluidSamples, VelocityBetweenCells) {
  const scene::Scene scene = scene::load_text(tank_with_ball);
  lbm::Fluid<double> fluid(fluid_options(scene));
  const auto view = view_of(fluid);
  fluid.fill(liquid_regions(scene));
  for (int s = 0; s < 50; ++s) fluid.step();
  const Vec3 a = view->domain().centre(view->domain().cell_at({0.055, 0.055, 0.155}));
  const double dx = scene.fluid.cell_size;
  const Vec3 at_a = view->cell_at(a)->velocity, beside = view->cell_at(a + Vec3(0, 0, dx))->velocity;
  ASSERT_GT((at_a - beside).norm(), 0);
  const auto velocity_of = [](const lbm::WetCell& c) { return c.velocity; };
  const auto velocity_at = [&](const Vec3& point) { return cases::velocity_at(*view, velocity_of, point); };
  EXPECT_LT((velocity_at(a) - at_a).norm(), 1e-12);
  EXPECT_LT((velocity_at(a + Vec3(0, 0, 0.25 * dx)) - (0.75 * at_a + 0.25 * beside)).norm(), 1e-12);
  EXPECT_TRUE(std::isnan(velocity_at({0.05, 0.05, 0.38}).x()));
  // Half of the cells around a point at the floor are wall.
  const Vec3 lowest(a.x(), a.y(), 0.5 * dx);
  EXPECT_LT((velocity_at({a.x(), a.y(), 0}) - view->cell_at(lowest)->velocity).norm(), 1e-12);
}

}  // namespace
}  // namespace lahar::cases
