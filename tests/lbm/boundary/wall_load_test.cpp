#include "lbm/boundary/wall_load.h"

#include <gtest/gtest.h>

#include <numeric>

#include "core/parallel.h"
#include "lbm/step/cell_moments.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Momentum of all liquid cells between two steps, N s.
Vec3 momentum_of(Fluid<double>& fluid) {
  Vec3 sum = Vec3::Zero();
  for (const BlockIndex b : fluid.grid().owned())
    for (int n = 0; n < kBlockCells; ++n) {
      if (!is_wet(fluid.grid().block(b).type[static_cast<std::size_t>(n)])) continue;
      const auto m = outgoing_moments(fluid.grid(), {b, n}, fluid.parity());
      sum += (1 + m.drho) * Vec3(m.u[0], m.u[1], m.u[2]);
    }
  return sum * fluid.units().mass() * fluid.units().velocity_to_si(1.0);
}

Vec3 sum_of(const std::vector<WallLoad>& loads) {
  return std::accumulate(loads.begin(), loads.end(), Vec3(Vec3::Zero()),
                         [](const Vec3& sum, const WallLoad& l) { return Vec3(sum + l.impulse); });
}

/// A closed box full of water, a moving lid, a ball and a wall that slips along `normal`, gravity across: what the
/// walls get is what gravity gives less what the water keeps. Returns what is missing, of what gravity gives.
double missing_momentum(const Vec3& normal, bool tile = false) {
  FluidOptions o = tank_options(Vec3(0.2, 0.16, 0.18), 0.01, 1.0);
  o.domain.faces[5] = FaceKind::closed;
  o.gravity = Vec3(1.5, -0.7, -9.81);
  o.kinematic_viscosity = 1e-4;
  o.domain.walls.add({"lid", HalfSpace{Vec3(0, 0, 0.18), -Vec3::UnitZ()}, WallSlip::no_slip, 0, Vec3(0.5, 0.2, 0)});
  o.domain.walls.add({"ball", SolidSphere{Vec3(0.093, 0.078, 0.071), 0.033}});
  o.domain.walls.add({"slide", HalfSpace{Vec3(0.03, 0, 0), normal.normalized()}, WallSlip::free_slip});
  if (tile) {
    o.domain.slip = WallSlip::free_slip;
    o.domain.walls.add({"tile", SolidBox{Vec3(0.08, 0.05, -0.05), Vec3(0.13, 0.11, 0)}});
  }
  Fluid<double> fluid(o);
  fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, no_pressure);
  fluid.step();  // the walls' first answers were set by the start
  fluid.measure_walls();
  EXPECT_EQ(fluid.wall_loads().size(), (tile ? 4u : 3u) + 6u);
  // What comes back at the end of a step counts from the next step on: the walls get it one step earlier.
  fluid.step();
  const Vec3 start = momentum_of(fluid), first = sum_of(fluid.wall_loads());
  EXPECT_GT(first.norm(), 0);
  const Vec3 weight = fluid.liquid_mass() * o.gravity;
  Vec3 booked = Vec3::Zero();
  const int steps = 400;
  fluid.measure_walls();
  for (int s = 0; s < steps; ++s) {
    if (s == steps - 1) booked = sum_of(fluid.wall_loads());
    fluid.step();
  }
  const Vec3 given = steps * o.time_step * weight;
  EXPECT_GT(fluid.wall_loads()[1].impulse.norm(), 1e-3 * given.norm());  // the ball feels something
  return (momentum_of(fluid) - start - given + first + booked).norm() / given.norm();
}

// What the moving lid gives in one corner and takes in the other differs by the liquid's density, and is owed for a
// step.
TEST(WallLoad, ClosesTheBooksOfMomentum) { EXPECT_LT(missing_momentum(Vec3::UnitX()), 1e-6); }

/// A no-slip tile in a floor that slips: links of the floor into the tile are sent back, and the floor gets all of
/// that.
TEST(WallLoad, ClosesTheBooksAroundATile) { EXPECT_LT(missing_momentum(Vec3::UnitX(), true), 1e-6); }

/// The links of a slipping wall in steps add mass that is given back a step later (boundary/wall_balance.h): on the way
/// it has weight but is not among the liquid.
TEST(WallLoad, LacksTheWeightOfWhatWallsInStepsOwe) { EXPECT_LT(missing_momentum(Vec3(1, 0, 0.4)), 1e-4); }

/// Water at rest with an immersed box: the box feels the weight that it displaces, the near wall the hydrostatic load
/// and its moment. The level is felt within half a cell (docs/fluid.md): 2.5 % of the depth here.
TEST(WallLoad, IsHydrostaticAtRest) {
  constexpr double depth = 0.2, width = 0.16, gravity = 9.81, density = 1000;
  FluidOptions o = tank_options(Vec3(0.24, width, 0.3), 0.01, 2.0);
  o.kinematic_viscosity = 1e-3;
  o.domain.walls.add({"near", HalfSpace{Vec3::Zero(), Vec3::UnitX()}});
  o.domain.walls.add({"box", SolidBox{Vec3(0.08, 0.04, 0.04), Vec3(0.16, 0.12, 0.12)}});
  Fluid<double> fluid(o);
  fluid.fill({{Vec3(0, 0, 0), Vec3(0.24, width, depth)}});
  for (int s = 0; s < 400; ++s) fluid.step();
  fluid.measure_walls();
  const double start = static_cast<double>(fluid.steps()) * o.time_step;
  for (int s = 0; s < 2000; ++s) fluid.step();
  const double span = static_cast<double>(fluid.steps()) * o.time_step - start;
  const Vec3 box = fluid.wall_loads()[1].impulse / span, near = fluid.wall_loads()[0].impulse / span;
  const Vec3 moment = fluid.wall_loads()[0].angular_impulse / span;
  const double lift = density * gravity * 0.08 * 0.08 * 0.08;
  EXPECT_NEAR(box.z(), lift, 0.02 * lift);
  EXPECT_NEAR(box.x(), 0, 0.01 * lift);
  const double push = density * gravity * width * depth * depth / 2;
  EXPECT_NEAR(near.x(), -push, 0.05 * push);
  EXPECT_NEAR(moment.y(), -push * depth / 3, 0.075 * push * depth / 3);
  EXPECT_NEAR(moment.z(), push * width / 2, 0.05 * push * width / 2);
  EXPECT_NEAR(sum_of(fluid.wall_loads()).z() / span, -fluid.liquid_mass() * gravity,
              0.02 * fluid.liquid_mass() * gravity);
}

/// Links into an edge press on both of its walls: the bed bears the weight, with no share of the sides', and none pulls
/// along the other.
TEST(WallLoad, EdgesPressOnBothWalls) {
  for (const WallSlip slip : {WallSlip::no_slip, WallSlip::free_slip}) {
    FluidOptions o = tank_options(Vec3(0.08, 0.08, 0.16), 0.01, 2.0);
    o.kinematic_viscosity = 1e-3;
    o.domain.slip = slip;
    Fluid<double> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(0.08, 0.08, 0.1)}});
    for (int s = 0; s < 400; ++s) fluid.step();
    fluid.measure_walls();
    const double start = fluid.time();
    for (int s = 0; s < 2000; ++s) fluid.step();
    const auto force = [&](std::size_t face) {
      return Vec3(fluid.wall_loads()[face].impulse / (fluid.time() - start));
    };
    const double weight = 9.81 * fluid.liquid_mass();
    EXPECT_NEAR(force(4).z() / weight, -1, 2e-3) << "bed";
    EXPECT_NEAR(force(4).head<2>().norm() / weight, 0, 1e-4);
    for (const std::size_t side : {0, 1}) EXPECT_NEAR(force(side).tail<2>().norm() / weight, 0, 2e-3) << side;
    const double push = 1000 * 9.81 * 0.08 * 0.1 * 0.1 / 2;
    EXPECT_NEAR(force(1).x() / push, 1, 0.05) << "the level is felt within half a cell";
    EXPECT_NEAR((force(0).x() + force(1).x()) / push, 0, 1e-3);
  }
}

/// Layers of some cells and a part, also of a part alone, at rest and down a bed that slips: its load is their weight,
/// without friction.
TEST(WallLoad, IsTheWeightOfLayers) {
  for (const double cells : {0.3, 1.6, 3.3}) {
    FluidOptions o = tank_options(Vec3(0.16, 0.16, 0.08), 0.01, 2.0);
    o.kinematic_viscosity = 1e-3;
    o.gravity = Vec3(2, 0, -9.81);
    o.domain.faces[0] = o.domain.faces[1] = o.domain.faces[2] = o.domain.faces[3] = FaceKind::periodic;
    o.domain.slip = WallSlip::free_slip;
    Fluid<double> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(0.16, 0.16, 0.01 * cells)}});
    for (int s = 0; s < 20; ++s) fluid.step();
    fluid.measure_walls();
    const double start = fluid.time();
    for (int s = 0; s < 400; ++s) fluid.step();
    const Vec3 load = sum_of(fluid.wall_loads()) / (fluid.time() - start), weight = fluid.liquid_mass() * o.gravity;
    EXPECT_NEAR(load.z() / weight.z(), 1, 0.02) << cells;
    EXPECT_NEAR(load.x() / weight.x(), 0, 0.01) << cells;
  }
}

/// A heap that falls apart on a bed that slips: no friction, though cells at its ends send into the mirror what comes
/// back to none.
TEST(WallLoad, MirrorsTakeNoFriction) {
  FluidOptions o = tank_options(Vec3(0.6, 0.1, 0.2), 0.01, 2.0);
  o.domain.slip = WallSlip::free_slip;
  Fluid<double> fluid(o);
  fluid.fill({{Vec3(0.15, 0, 0), Vec3(0.25, 0.1, 0.1), Vec3(0.8, 0, 0)}});
  fluid.measure_walls();
  while (fluid.time() < 0.08) fluid.step();
  const Vec3 bed = fluid.wall_loads()[4].impulse;
  EXPECT_LT(bed.z(), -0.5 * fluid.liquid_mass() * 9.81 * fluid.time());
  EXPECT_NEAR(bed.x(), 0, 1e-12 * std::abs(bed.z()));
}

/// A dam break on a box: the same bits with one and two threads, and the flow is the same whether it is measured or
/// not.
TEST(WallLoad, DoesNotDependOnThreadsNorChangeTheFlow) {
  Vec3 impulse[2];
  double mass[3];
  for (int run = 0; run < 3; ++run) {
    const ThreadLimit limit(run == 1 ? 2 : 1);
    FluidOptions o = tank_options(Vec3(0.4, 0.1, 0.2), 0.01, 2.0);
    o.domain.walls.add({"box", SolidBox{Vec3(0.3, 0.03, 0), Vec3(0.34, 0.07, 0.1)}});
    Fluid<float> fluid(o);
    fluid.fill({{Vec3(0, 0, 0), Vec3(0.15, 0.1, 0.15)}});
    if (run < 2) fluid.measure_walls();
    for (int s = 0; s < 600; ++s) fluid.step();
    if (run < 2) impulse[run] = fluid.wall_loads()[0].impulse;
    mass[run] = 0;
    fluid.for_each_wet_cell([&](const WetCell& c) { mass[run] += c.liquid_volume * c.centre.x() * c.velocity.z(); });
  }
  EXPECT_GT(impulse[0].x(), 0);
  EXPECT_EQ(impulse[0], impulse[1]);
  EXPECT_EQ(mass[0], mass[1]);
  EXPECT_EQ(mass[0], mass[2]);
}

}  // namespace
}  // namespace lahar::lbm
