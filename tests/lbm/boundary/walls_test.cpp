#include "lbm/boundary/wall_reflection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Water sliding along a tilted free-slip plane cut out of the lattice: no link of a wall may change the mass.
TEST(WallReflection, KeepsMassAtSteps) {
  FluidOptions o = tank_options(Vec3(0.4, 0.1, 0.4), 0.01, 2.0);
  o.domain.walls.add({"ramp", HalfSpace{Vec3(0, 0, 0.1), Vec3(0.5, 0, 1).normalized()}, WallSlip::free_slip});
  Fluid<double> fluid(o);
  fluid.fill({{Vec3(0, 0, 0), Vec3(0.12, 0.1, 0.3)}});
  const double start = fluid.liquid_mass();
  ASSERT_GT(start, 0.5);
  for (int s = 0; s < 600; ++s) fluid.step();
  EXPECT_NEAR(fluid.liquid_mass() / start, 1, 1e-12);
}

/// Free slip on a plane of 45 degrees: a drop of liquid slides nearly without loss, with a no-slip wall it is slower.
TEST(WallReflection, SlipAndNoSlipDiffer) {
  double speed[2];
  for (const WallSlip slip : {WallSlip::no_slip, WallSlip::free_slip}) {
    FluidOptions o = tank_options(Vec3(0.8, 0.08, 0.3), 0.01, 2.0);
    o.kinematic_viscosity = 1e-3;
    o.gravity = Vec3(4.0, 0, -9.0);
    for (const double y : {0.0, 0.08})
      o.domain.walls.add(
          {"side", HalfSpace{Vec3(0, y, 0), y > 0 ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitY())}, WallSlip::free_slip});
    o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, slip});
    Fluid<double> fluid(o);
    fluid.fill({{Vec3(0.05, 0, 0), Vec3(0.3, 0.08, 0.05)}});
    const double duration = 0.15;
    while (static_cast<double>(fluid.steps()) * o.time_step < duration) fluid.step();
    double momentum = 0, volume = 0;
    fluid.for_each_wet_cell([&](const WetCell& c) {
      momentum += c.liquid_volume * c.velocity.x();
      volume += c.liquid_volume;
    });
    speed[slip == WallSlip::free_slip] = momentum / volume / (4.0 * duration);
  }
  EXPECT_NEAR(speed[1], 1, 0.03);  // as a body without friction
  EXPECT_LT(speed[0], 0.9);
}

/// Liquid that moves with its walls goes on with them, however heavy it is at the bed (a tenth denser than above; where
/// belts pulled as on liquid of density 1 it was 5 % slow there).
TEST(WallReflection, BeltsCarryDenseLiquidAlong) {
  constexpr double speed = 0.05, height = 40, gravity = 0.1 / (3 * height);
  FluidOptions o = lattice_options({8, 8, 40}, 0.05);
  o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  o.gravity = Vec3(0, 0, -gravity);
  for (const double side : {-1.0, 1.0}) {
    Wall belt{"belt", HalfSpace{Vec3(0, 0, side < 0 ? 0 : height), Vec3(-side * Vec3::UnitZ())}, WallSlip::no_slip};
    belt.velocity = Vec3(speed, 0, 0);
    o.domain.walls.add(belt);
  }
  Fluid<double> fluid(o);
  fluid.fill_everything([&](const Vec3&) { return Vec3(speed, 0, 0); },
                        [&](const Vec3& p) { return std::expm1(3 * gravity * (height / 2 - p.z())); });
  for (int s = 0; s < 3000; ++s) fluid.step();
  fluid.for_each_wet_cell([&](const WetCell& c) { EXPECT_NEAR(c.velocity.x() / speed, 1, 2e-3) << c.centre.z(); });
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
}

}  // namespace
}  // namespace lahar::lbm
