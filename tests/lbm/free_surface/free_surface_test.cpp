#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"
#include "core/worst.h"
#include "lbm/step/dry_blocks.h"
#include "tests/alternatives.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

FluidOptions dam(double cell_size) {
  FluidOptions o = tank_options(Vec3(0.8, 0.16, 0.5), cell_size, 3.0, 0.1);
  o.smagorinsky = 0.1;
  return o;
}

/// A time step far too long for the fall of the water: the limit of the speed must not hide it.
TEST(FreeSurface, TooLongAStepStopsTheRun) {
  FluidOptions o =
      tank_options(Vec3(0.8, 0.4, 0.8), 0.02, 0.3);  // 0.05 lu at 0.3 m/s; the water gets ten times as fast
  Fluid<float> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.3, 0.4, 0.6)}});
  const auto run = [&] {
    for (int s = 0; s < 2000; ++s) fluid.step();
  };
  try {
    run();
    FAIL() << "it went on";
  } catch (const NumericalFailure& failure) {
    EXPECT_NE(failure.cause().find("the time step is too long"), std::string::npos) << failure.cause();
  }
}

/// A region that reaches the upper end of a periodic axis is filled once.
TEST(FreeSurface, RegionUpToThePeriodicEndIsFilledOnce) {
  FluidOptions o = tank_options(Vec3(0.8, 0.8, 0.8), 0.1, 4);
  o.domain.faces[0] = o.domain.faces[1] = FaceKind::periodic;
  Fluid<double> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.8, 0.8, 0.35)}});
  EXPECT_NEAR(fluid.liquid_mass() / (1000 * 0.8 * 0.8 * 0.35), 1, 0.01);  // compressed by its own weight
}

/// Water in a tank stays at rest, with the pressure of its depth, wherever the level stands in a cell.
TEST(FreeSurface, HydrostaticRest) {
  for (const double depth : {0.2, 0.203, 0.205}) {
    FluidOptions o = tank_options(Vec3(0.16, 0.16, 0.4), 0.01, 2.0);
    o.kinematic_viscosity = 1e-4;
    Fluid<double> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(0.16, 0.16, depth)}});
    for (int s = 0; s < 2000; ++s) fluid.step();
    EXPECT_LT(largest_speed(fluid), 1e-4);
    double pressure = 0;
    for (int s = 0; s < 200; ++s) {
      fluid.step();
      pressure += fluid.cell_at(Vec3(0.085, 0.085, 0.005))->pressure / 200;
    }
    // The gas pressure acts on the surface (lbm/free_surface/surface_exchange.h); water is compressed by 0.4 % at the
    // bottom, 0.08 cells of the whole column, and may still swing a little.
    EXPECT_NEAR(pressure, 9810 * (depth - 0.005), 9810 * 0.0015) << "depth " << depth;
    EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
  }
}

/// The same with the viscosity of water, which damps nothing: roundings must not grow. (With levels in the lower half
/// of a cell they reached 0.02 m/s in 0.8 s, docs/decisions/0083.)
TEST(FreeSurface, StillWaterStaysStillWhateverItsLevel) {
  constexpr double dx = 0.005;
  for (const double level : {12.02, 12.05, 12.1, 12.3, 12.49, 12.6})
    for (const WallSlip slip : {WallSlip::free_slip, WallSlip::no_slip}) {
      FluidOptions o = tank_options(Vec3(16 * dx, 8 * dx, 20 * dx), dx, 0.5, 0.05);
      o.domain.slip = slip;
      Fluid<double> fluid(o);
      fluid.fill({{Vec3::Zero(), Vec3(16 * dx, 8 * dx, level * dx)}});
      for (int s = 0; s < 2400; ++s) fluid.step();  // 1.2 s
      EXPECT_LT(largest_speed(fluid), 1e-4) << level << ' ' << static_cast<int>(slip);
    }
}

/// Layers of a cell or two whose level lies in the lower half of the next one, too: they rose by themselves as waves of
/// two cells, fastest cells to 3 to 16 cm/s.
TEST(FreeSurface, StillLayersStayStill) {
  constexpr double dx = 0.01;
  for (const double level : {1.03, 1.1, 1.2, 2.2}) {
    FluidOptions o = tank_options(Vec3(16 * dx, 16 * dx, 8 * dx), dx, 1, 0.1);
    o.domain.slip = WallSlip::free_slip;
    Fluid<float> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(16 * dx, 16 * dx, level * dx)}});
    while (fluid.time() < 4) fluid.step();
    EXPECT_LT(largest_speed(fluid), 1e-4) << level;
  }
}

/// Least and largest force of the walls across a bed, over the liquid's weight there, in the steps from one time to
/// another.
std::pair<double, double> borne(Fluid<double>& fluid, double from, double to) {
  const FluidOptions& o = fluid.options();
  fluid.measure_walls();
  const double weight = -o.gravity.z() * fluid.liquid_mass() * o.time_step;
  const auto impulse = [&] {
    double sum = 0;
    for (const WallLoad& load : fluid.wall_loads()) sum -= load.impulse.z();
    return sum;
  };
  double least = 1e9, largest = -1e9;
  for (double before = 0; fluid.time() < to; before = impulse()) {
    fluid.step();
    if (fluid.time() < from) continue;
    least = std::min(least, (impulse() - before) / weight), largest = std::max(largest, (impulse() - before) / weight);
  }
  return {least, largest};
}

/// A pressure at the surface that follows the sound between it and the bed feeds it: the bed of one cell of water and a
/// bit bore -2 to 4 times its weight, of three cells a half to one and a half (docs/decisions/0089).
TEST(FreeSurface, ThinLayersRestOnTheirBed) {
  constexpr double dx = 0.02;
  for (const int cells : {1, 2, 3, 4, 6})
    for (const double level : {0.02, 0.1, 0.3, 0.5, 0.9}) {
      FluidOptions o = tank_options(Vec3(8 * dx, 8 * dx, 12 * dx), dx, 2, 0.1);
      o.domain.slip = WallSlip::free_slip;
      Fluid<double> fluid(o);
      fluid.fill({{Vec3::Zero(), Vec3(8 * dx, 8 * dx, (cells + level) * dx)}});
      const auto [least, largest] = borne(fluid, 0.3, 0.5);
      EXPECT_GT(least, 0.97) << cells + level;
      EXPECT_LT(largest, 1.03) << cells + level;
    }
}

/// The same with surface tension, for longer, and of less than a cell. By the gradient of the cells' own densities they
/// moved with 2 to 8 cm/s.
TEST(FreeSurface, ThinLayersUnderTensionRest) {
  constexpr double dx = 0.01;
  for (const double depth : {0.5, 0.9, 2.1, 3.05, 4.05}) {
    FluidOptions o = tank_options(Vec3(24 * dx, 16 * dx, 8 * dx), dx, 1, 0.1);
    o.domain.slip = WallSlip::free_slip;
    o.surface_tension = 0.0728;
    Fluid<double> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(24 * dx, 16 * dx, depth * dx)}});
    while (fluid.time() < 2) fluid.step();
    EXPECT_LT(largest_speed(fluid), 2e-4) << depth;
  }
}

/// The same of sheets that slide down a slope.
TEST(FreeSurface, SlidingSheetsRestOnTheirBed) {
  constexpr double dx = 0.02, angle = 35 * std::numbers::pi / 180;
  for (const double depth : {1.5, 2.2, 3.05, 4.1}) {
    FluidOptions o = tank_options(Vec3(8 * dx, 8 * dx, 12 * dx), dx, 7, 0.1);
    o.domain.faces.fill(FaceKind::periodic);
    o.domain.faces[4] = FaceKind::closed, o.domain.faces[5] = FaceKind::open;
    o.domain.slip = WallSlip::free_slip;
    o.smagorinsky = 0.16;
    o.gravity = 9.81 * Vec3(std::sin(angle), 0, -std::cos(angle));
    Fluid<double> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(8 * dx, 8 * dx, depth * dx)}});
    const auto [least, largest] = borne(fluid, 0.3, 0.5);
    EXPECT_GT(least, 0.95) << depth;
    EXPECT_LT(largest, 1.05) << depth;
  }
}

/// What weighs on a cell is no velocity along the walls beside it, where two of them meet either.
TEST(FreeSurface, EdgesOfNoSlipTanksDriveNothing) {
  for (const double viscosity : {0.05, 0.1}) {
    FluidOptions o = lattice_options(Vec3i(16, 16, 24), viscosity);
    o.domain.faces.fill(FaceKind::closed);
    o.domain.faces[5] = FaceKind::open;
    o.gravity = Vec3(0, 0, -4e-4);
    Fluid<double> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(16, 16, 14.59)}});
    for (int s = 0; s < 2000; ++s) fluid.step();
    EXPECT_LT(largest_speed(fluid), 1e-6) << viscosity;
  }
}

/// A block of water in the air falls like a stone.
TEST(FreeSurface, FreeFall) {
  FluidOptions o = tank_options(Vec3(0.24, 0.24, 0.8), 0.01, 3.0);
  Fluid<double> fluid(o);
  fluid.fill({{Vec3(0.08, 0.08, 0.6), Vec3(0.16, 0.16, 0.7)}});
  const auto centre = [&] {
    double z = 0, volume = 0;
    fluid.for_each_wet_cell([&](const WetCell& c) { z += c.centre.z() * c.liquid_volume, volume += c.liquid_volume; });
    return z / volume;
  };
  const double start = centre();
  while (static_cast<double>(fluid.steps()) * o.time_step < 0.25) fluid.step();
  const double t = static_cast<double>(fluid.steps()) * o.time_step;
  EXPECT_NEAR((start - centre()) / (0.5 * 9.81 * t * t), 1, 0.05);
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
}

/// Water on which no surface, no conversion and no collision operator may act: only its weight does.
template <class Operator>
class FreeFlight : public testing::Test {
 public:
  static FluidOptions in_gas(const Vec3i& cells) {
    FluidOptions o = lattice_options(cells, 0.01);
    o.domain.faces = {};
    o.collision = Operator{};
    return o;
  }
};
TYPED_TEST_SUITE(FreeFlight, AlternativeTypes<CollisionOperator>);

/// A bar of water that moves along itself goes on as a solid does.
TYPED_TEST(FreeFlight, ABarThatMovesAlongItselfKeepsItsShape) {
  FluidOptions o = this->in_gas({16, 24, 24});
  o.domain.faces[0] = o.domain.faces[1] = FaceKind::periodic;
  Fluid<double> fluid(o);
  fluid.fill({{Vec3(0, 8, 8), Vec3(16, 16, 16), Vec3(0.1, 0, 0)}});
  for (int s = 0; s < 200; ++s) fluid.step();
  double across = 0, along = 0, inside = 0, outside = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) {
    const bool in_bar = (c.centre.tail<2>().array() > 8).all() && (c.centre.tail<2>().array() < 16).all();
    (in_bar ? inside : outside) += c.liquid_volume;
    across = std::max({across, std::abs(c.velocity.y()), std::abs(c.velocity.z())});
    along = std::max(along, std::abs(c.velocity.x() - 0.1));
  });
  EXPECT_LT(across, 1e-12);
  EXPECT_LT(along, 1e-12);
  EXPECT_NEAR(inside, 16 * 8 * 8, 1e-9);
  EXPECT_NEAR(outside, 0, 1e-9);
}

/// A block flies at an angle to the lattice and falls, 21 cells far and at up to 0.13 lu.
TYPED_TEST(FreeFlight, ABlockMovesAsASolidDoes) {
  FluidOptions o = this->in_gas({64, 40, 24});
  o.gravity = Vec3(3e-4, 1.5e-4, 0);
  Fluid<double> fluid(o);
  const Vec3 start(0.04, 0.02, 0.016);
  fluid.fill({{Vec3(8, 8, 6), Vec3(16, 16, 14), start}});
  for (int s = 0; s < 250; ++s) fluid.step();
  const Vec3 expected = start + fluid.time() * o.gravity;
  double off = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) { keep_worst(off, (c.velocity - expected).norm()); });
  EXPECT_LT(off, 1e-12);
  EXPECT_GT(fluid.wet_cells(), 0U);
  EXPECT_FALSE(fluid.cell_at(Vec3(12.5, 12.5, 10.5))) << "it has not left";
}

/// How a wave of a tenth of a cell on the upper side of a slab of water has moved in the time that the slab needs for
/// 32 cells: the way, and the amplitude over the first one.
template <class Operator>
std::pair<double, double> wave_on_a_slab(int length, double speed) {
  constexpr double amplitude = 0.1;
  FluidOptions o = FreeFlight<Operator>::in_gas({length, 8, 24});
  for (const int face : {0, 1, 2, 3}) o.domain.faces[static_cast<std::size_t>(face)] = FaceKind::periodic;
  Fluid<double> fluid(o);
  const double k = 2 * std::numbers::pi / length;
  std::vector<LiquidRegion> columns;
  for (int x = 0; x < length; ++x) {
    const double top = 14.5 + amplitude * std::sin(k * (x + 0.5));
    columns.push_back({Vec3(x, 0, 6), Vec3(x + 1, 8, top), Vec3(speed, 0, 0)});
  }
  fluid.fill(columns);
  double angle = 0;
  std::complex<double> now(0, -1);
  for (int s = 0; s < static_cast<int>(std::lround(32 / speed)); ++s) {
    fluid.step();
    std::complex<double> next = 0;
    fluid.for_each_wet_cell([&](const WetCell& c) {
      next += c.liquid_volume * std::polar(2.0 / (8 * length * amplitude), -k * c.centre.x());
    });
    angle += std::arg(now / next);
    now = next;
  }
  return {angle / k, std::abs(now)};
}

/// The surface goes with the water under it, and a fast one gets no rougher (docs/decisions/0066). With the mass that
/// whole links carry a wave goes two thirds of the way, and one of 8 cells grows by two fifths
/// at 0.1 lu, to twice its height at 0.2.
TYPED_TEST(FreeFlight, AWaveOnASlabGoesWithIt) {
  const auto [way, size] = wave_on_a_slab<TypeParam>(32, 0.1);
  EXPECT_NEAR(way, 32, 0.32);
  EXPECT_NEAR(size, 1, 0.01);
  EXPECT_LT(wave_on_a_slab<TypeParam>(8, 0.1).second, 1);
  EXPECT_LT(wave_on_a_slab<TypeParam>(8, 0.2).second, 1);
}

/// A small block arrives whole: no part of it is left behind. With the mass that whole links carry its centre is 1.7
/// and 1.0 cells late.
TYPED_TEST(FreeFlight, ABlockArrivesWhole) {
  for (const auto& [way, late] : {std::pair(Vec3(1, 0, 0), 0.1), std::pair(Vec3(1, 0.5, 0.3), 0.45)}) {
    Fluid<double> fluid(this->in_gas({64, 40, 32}));
    const Vec3 velocity = 0.1 * way.normalized();
    fluid.fill({{Vec3(8, 8, 8), Vec3(16, 16, 16), velocity}});
    for (int s = 0; s < 400; ++s) fluid.step();
    Vec3 sum = Vec3::Zero();
    double volume = 0;
    fluid.for_each_wet_cell([&](const WetCell& c) { sum += c.liquid_volume * c.centre, volume += c.liquid_volume; });
    const Vec3 behind = Vec3(12, 12, 12) + fluid.time() * velocity - sum / volume;
    EXPECT_NEAR(behind.dot(way.normalized()), 0, late) << "along (" << way.x() << ", " << way.y() << ", ...)";
  }
}

template <class Real>
double dam_break_drift(int steps) {
  Fluid<Real> fluid(dam(0.02));
  fluid.fill({{Vec3::Zero(), Vec3(0.2, 0.16, 0.3)}});
  double worst = 0;
  for (int s = 0; s < steps; ++s) {
    fluid.step();
    keep_worst(worst, std::abs(fluid.mass_drift()));
  }
  return worst;
}

/// A layer that slides down a slipping bed of 35 degrees, as deep everywhere, wins exactly g sin(35) t. What the
/// pressure holds across must not speed it up along: with the velocity that cells send out, taken for that of half a
/// step on, gas faces give (g cos 35) dt / (2 depth) of the speed a step, 0.2 % here.
TEST(FreeSurface, ALayerSlidesAsFastAsGravityPulls) {
  for (const double depth : {4.5, 9.5}) {  // cells
    constexpr double dx = 0.02, start = 2, angle = 35 * std::numbers::pi / 180;
    FluidOptions o;
    o.domain.upper = Vec3(8 * dx, 8 * dx, 16 * dx);
    o.domain.cell_size = dx;
    o.domain.faces.fill(FaceKind::periodic);
    o.domain.faces[4] = FaceKind::closed, o.domain.faces[5] = FaceKind::open;
    o.domain.slip = WallSlip::free_slip;
    o.time_step = 0.1 * dx / 7;
    o.kinematic_viscosity = 1e-6;
    o.smagorinsky = 0.16;
    o.gravity = 9.81 * Vec3(std::sin(angle), 0, -std::cos(angle));
    Fluid<double> fluid(o);
    LiquidRegion layer{Vec3::Zero(), Vec3(8 * dx, 8 * dx, depth * dx)};
    layer.velocity = Vec3(start, 0, 0);
    fluid.fill({layer});
    const int steps = static_cast<int>(0.5 / o.time_step);
    for (int s = 0; s < steps; ++s) fluid.step();
    double volume = 0, flow = 0;
    fluid.for_each_wet_cell(
        [&](const WetCell& c) { volume += c.liquid_volume, flow += c.liquid_volume * c.velocity.x(); });
    EXPECT_NEAR(flow / volume / (start + o.gravity.x() * steps * o.time_step), 1, 1e-4) << depth << " cells";
  }
}

/// Where blocks begin is of no account: a dam break in a domain that begins some cells earlier, in the walls, is the
/// same.
TEST(FreeSurface, DoesNotDependOnWhereBlocksBegin) {
  const auto levels = [](const Vec3i& earlier) {
    const double dx = 0.02;
    FluidOptions o = tank_options(Vec3(0.48, 0.16, 0.32), dx, 3.0, 0.1);
    o.domain.lower = -dx * earlier.cast<double>();
    for (int axis = 0; axis < 3; ++axis)
      o.domain.walls.add({"side", HalfSpace{Vec3::Zero(), Vec3(Vec3::Unit(axis))}, WallSlip::free_slip});
    Fluid<double> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(0.17, 0.09, 0.25)}});
    for (int s = 0; s < 60; ++s) fluid.step();
    std::vector<double> found;
    for (int x = 0; x < 24; ++x)
      for (int y = 0; y < 8; ++y)
        for (int z = 0; z < 16; ++z) {
          const auto cell = fluid.cell_at(dx * Vec3(x + 0.5, y + 0.5, z + 0.5));
          found.push_back(cell ? cell->fill_level : 0.0);
        }
    return found;
  };
  const std::vector<double> here = levels(Vec3i(8, 8, 8)), there = levels(Vec3i(5, 3, 2));
  double largest = 0;
  for (std::size_t k = 0; k < here.size(); ++k) largest = std::max(largest, std::abs(here[k] - there[k]));
  std::printf("    largest difference of a level after 60 steps: %.1e\n", largest);
  EXPECT_LT(largest, 1e-9);
}

TEST(FreeSurface, DamBreakKeepsItsMass) {
  EXPECT_LT(dam_break_drift<double>(2000), 1e-10);
  EXPECT_LT(dam_break_drift<float>(2000), 1e-6);
}

/// Nearly inviscid, no eddy viscosity: a column of 0.3 m x 0.6 m collapses, runs into the end wall at 0.45 s and comes
/// back. The impact throws liquid up, so that the speed of the fall from the full height is no strict bound.
TEST(FreeSurface, DamBreakIsStableWithoutEddyViscosity) {
  const double height = 0.6, speed = std::sqrt(2 * 9.81 * height);
  FluidOptions o = tank_options(Vec3(1.6, 0.16, 0.8), 0.02, speed, 0.1);
  Fluid<float> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.3, 0.16, height)}});
  double fastest = 0, front = 0;
  while (static_cast<double>(fluid.steps()) * o.time_step < 1.5) {
    fluid.step();
    if (fluid.steps() % 50 == 0) fastest = std::max(fastest, largest_speed(fluid));
    if (fluid.steps() != static_cast<std::int64_t>(0.3 / o.time_step)) continue;
    fluid.for_each_wet_cell([&](const WetCell& c) { front = std::max(front, c.centre.x()); });
  }
  EXPECT_NEAR(front, 0.88, 0.06);  // Martin & Moyce 1952, n^2 = 2
  EXPECT_LT(fastest, 2 * speed);
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-6);
  EXPECT_LT(static_cast<double>(fluid.account().limited), 0.01 * fluid.cell_updates());
}

TEST(FreeSurface, WhatLeavesIsBooked) {
  FluidOptions o = dam(0.02);
  o.domain.faces[1] = FaceKind::open;
  o.gravity = Vec3(5.6, 0, -8.0);
  Fluid<double> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.2, 0.16, 0.2)}});
  for (int s = 0; s < 2500; ++s) fluid.step();
  EXPECT_GT(fluid.outflow_mass(), 0.5 * (fluid.liquid_mass() + fluid.outflow_mass()));
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
}

/// Blocks follow the liquid: an empty box costs nothing.
TEST(FreeSurface, BlocksFollowTheLiquid) {
  FluidOptions o = dam(0.02);
  o.domain.upper = Vec3(8, 1.6, 4);
  Fluid<float> fluid(o);
  fluid.fill({{Vec3(2, 0.4, 1), Vec3(2.2, 0.6, 1.2)}});
  release_dry_blocks(fluid.grid());
  const auto start = fluid.grid().owned().size();
  EXPECT_LT(start, 80U);  // the box has 6000
  for (int s = 0; s < 320; ++s) fluid.step();
  EXPECT_LT(fluid.grid().owned().size(), 80U);
}

TEST(FreeSurface, SameResultWithAnyNumberOfThreads) {
  const auto fingerprint = [](int threads) {
    const ThreadLimit limit(threads);
    Fluid<float> fluid(dam(0.02));
    fluid.fill({{Vec3::Zero(), Vec3(0.2, 0.16, 0.3)}});
    for (int s = 0; s < 400; ++s) fluid.step();
    std::vector<double> values;
    fluid.for_each_wet_cell([&](const WetCell& c) {
      values.push_back(c.fill_level);
      values.push_back(c.velocity.x());
      values.push_back(c.pressure);
    });
    return values;
  };
  const auto one = fingerprint(1), two = fingerprint(2);
  ASSERT_EQ(one.size(), two.size());
  EXPECT_EQ(one, two);
}

}  // namespace
}  // namespace lahar::lbm
