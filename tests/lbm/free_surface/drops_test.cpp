#include "lbm/free_surface/drops.h"

#include <gtest/gtest.h>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// The draws are even: each axis gets its share of the steps.
TEST(Drops, MoveAtTheMeanSpeed) {
  const double u[3] = {0.1, -0.03, 0.007};
  int moves[7] = {};
  for (std::uint64_t round = 1; round <= 10000; ++round) ++moves[drop_direction(u, round)];
  EXPECT_NEAR(moves[1], 1000, 3);
  EXPECT_NEAR(moves[4], 300, 3);
  EXPECT_NEAR(moves[5], 70, 3);
  EXPECT_EQ(moves[2] + moves[3] + moves[6], 0);
}

struct Fall {
  double distance, drift, speed;  ///< over those of a stone
  double mass_drift;
};

/// Liquid let go in the air with a speed along x, after 0.4 s.
Fall let_fall(const Vec3& size, double speed_x) {
  FluidOptions o = tank_options(Vec3(0.8, 0.4, 1.2), 0.02, 3.43, 0.1);
  Fluid<double> fluid(o);
  const Vec3 corner(0.1, 0.16, 1.0);
  fluid.fill({{corner, corner + size, Vec3(speed_x, 0, 0)}});
  const auto mean = [&](const auto& value) {
    double sum = 0, volume = 0;
    fluid.for_each_wet_cell([&](const WetCell& c) { sum += value(c) * c.liquid_volume, volume += c.liquid_volume; });
    return sum / volume;
  };
  const auto x = [](const WetCell& c) { return c.centre.x(); };
  const auto z = [](const WetCell& c) { return c.centre.z(); };
  const double x0 = mean(x), z0 = mean(z);
  while (static_cast<double>(fluid.steps()) * o.time_step < 0.4) fluid.step();
  const double t = static_cast<double>(fluid.steps()) * o.time_step;
  const double w = mean([](const WetCell& c) { return c.velocity.z(); });
  return {(z0 - mean(z)) / (0.5 * 9.81 * t * t), speed_x > 0 ? (mean(x) - x0) / (speed_x * t) : 1, -w / (9.81 * t),
          fluid.mass_drift()};
}

/// A drop within one cell flies like a stone.
TEST(Drops, OneCellFliesLikeAStone) {
  const Fall fall = let_fall(Vec3::Constant(0.016), 1.0);
  EXPECT_NEAR(fall.distance, 1, 0.03);
  EXPECT_NEAR(fall.drift, 1, 0.05);
  EXPECT_NEAR(fall.speed, 1, 0.01);
  EXPECT_NEAR(fall.mass_drift, 0, 1e-12);
}

/// A sheet thinner than a cell has no neighbour to flow to and must fall all the same.
TEST(Drops, ThinSheetFalls) {
  const Fall fall = let_fall(Vec3(0.12, 0.12, 0.012), 0.0);
  EXPECT_NEAR(fall.distance, 1, 0.04);  // a cell is 0.025
  EXPECT_NEAR(fall.speed, 1, 0.01);
  EXPECT_NEAR(fall.mass_drift, 0, 1e-12);
}

/// Drops of a few cells lag behind, since mass enters an empty cell at half speed, but do not hang in the air, and do
/// not get faster than a stone.
TEST(Drops, SmallDropsNeitherHangNorRace) {
  for (const double size : {0.026, 0.04, 0.05}) {
    const Fall fall = let_fall(Vec3::Constant(size), 0.0);
    EXPECT_GT(fall.distance, 0.65) << size;
    EXPECT_LT(fall.distance, 1.02) << size;
    EXPECT_NEAR(fall.speed, 1, 0.1) << size;
    EXPECT_NEAR(fall.mass_drift, 0, 1e-12);
  }
}

/// A drop on a slipping slope of 45 degrees always has a step behind it. It runs down all the same, somewhat faster
/// than a body without friction, as it falls freely between steps.
TEST(Drops, RunDownSteps) {
  FluidOptions o = tank_options(Vec3(0.8, 0.4, 1.2), 0.02, 3.43, 0.1);
  o.domain.walls.add({"slope", HalfSpace{Vec3(0, 0, 0.005), Vec3(-1, 0, 1).normalized()}, WallSlip::free_slip});
  Fluid<double> fluid(o);
  const Vec3 corner(0.702, 0.202, 0.722);
  fluid.fill({{corner, corner + Vec3::Constant(0.016)}});
  const auto along = [&] {  // way down the slope
    double sum = 0, volume = 0;
    fluid.for_each_wet_cell([&](const WetCell& c) {
      sum -= c.liquid_volume * (c.centre.x() + c.centre.z()) / std::sqrt(2.0), volume += c.liquid_volume;
    });
    return sum / volume;
  };
  const double start = along();
  while (static_cast<double>(fluid.steps()) * o.time_step < 0.4) fluid.step();
  const double t = static_cast<double>(fluid.steps()) * o.time_step;
  const double run = (along() - start) / (0.5 * 9.81 / std::sqrt(2.0) * t * t);
  EXPECT_GT(run, 0.9);
  EXPECT_LT(run, 1.4);
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
}

}  // namespace
}  // namespace lahar::lbm
