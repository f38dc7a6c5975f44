// How long an adaptive step may be, and options that do not go together.
#include "lbm/step/fluid_options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

FluidOptions water(double cell_size) {
  FluidOptions o = tank_options(Vec3(32, 16, 16) * cell_size, cell_size, 2.0);
  o.adaptive_time_step = true;
  o.density = 1000;
  return o;
}

TEST(TimeStepLimits, HoldWhatTheOptionsSay) {
  FluidOptions o = water(0.01);
  o.lattice_velocity = 0.07, o.uncounted_share = 0.002, o.gravity = Vec3(3, 0, -4);
  const TimeStepLimits limits = time_step_limits(o, Domain(o.domain));
  EXPECT_EQ(limits.target, 0.07);
  EXPECT_EQ(limits.uncounted, 0.002);
  EXPECT_EQ(limits.cell_size, 0.01);
  EXPECT_EQ(limits.gravity, 5);
  EXPECT_EQ(limits.shortest, o.time_step / 32);
  EXPECT_EQ(limits.known_speed, 0);
}

/// tau = 1 at the longest: dx^2/(6 nu), of mud by its largest viscosity; never below the first step.
TEST(TimeStepLimits, ByTheViscosity) {
  FluidOptions o = water(0.01);
  o.kinematic_viscosity = 1e-3;
  EXPECT_NEAR(time_step_limits(o, Domain(o.domain)).longest, 1e-4 / 6e-3, 1e-12);
  o.rheology = {FlowLaw::bingham, 10, 0, 1, 0.02};
  EXPECT_NEAR(time_step_limits(o, Domain(o.domain)).longest, 1e-4 / 0.12, 1e-12);
  o.rheology.limit_viscosity = 10;
  EXPECT_EQ(time_step_limits(o, Domain(o.domain)).longest, o.time_step);
}

/// Ripples of two cells: sqrt(rho dx^3/(4 pi sigma)).
TEST(TimeStepLimits, BySurfaceTension) {
  FluidOptions o = water(0.002);
  o.surface_tension = 0.0728;
  EXPECT_NEAR(time_step_limits(o, Domain(o.domain)).longest, 2.957e-3, 1e-6);
}

/// A step that grows with tension stops short of what ripples allow.
TEST(TimeStepLimits, AdaptiveStepsWithTensionGoOn) {
  FluidOptions o = water(0.002);
  o.surface_tension = 0.0728, o.gravity = Vec3(0, 0, -0.01);
  o.time_step = 2.4e-3;
  Fluid<float> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.064, 0.032, 0.016)}});
  for (int s = 0; s < 400; ++s) fluid.step();
  EXPECT_NEAR(fluid.units().time_step, 2.957e-3, 1e-6);
}

/// Walls and inflows move whatever the liquid does; a wall that turns is fastest at a corner of the domain.
TEST(TimeStepLimits, KnowTheSpeedOfWallsAndInflows) {
  FluidOptions o = water(0.01);
  o.domain.walls.add({.name = "belt", .shape = HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, .velocity = Vec3(3, 0, 0)});
  EXPECT_EQ(time_step_limits(o, Domain(o.domain)).known_speed, 3);
  o.inflows.push_back({"in", Vec3::Zero(), Vec3(0.04, 0.16, 0.05), Vec3(3, 4, 0), {{{0, 0}, {1, 0}}}});
  EXPECT_EQ(time_step_limits(o, Domain(o.domain)).known_speed, 5);
  o.domain.walls.add({.name = "disc",
                      .shape = HalfSpace{Vec3::Zero(), Vec3::UnitZ()},
                      .angular_velocity = Vec3(0, 0, 50),
                      .centre = Vec3(0.16, 0.08, 0)});
  EXPECT_NEAR(time_step_limits(o, Domain(o.domain)).known_speed, 50 * std::hypot(0.16, 0.08), 1e-12);
}

TEST(FluidOptions, RefusesWhatDoesNotGoTogether) {
  const auto refused = [](const auto& change) {
    FluidOptions o = water(0.01);
    change(o);
    try {
      parameters_of(o, units_of(o));
    } catch (const std::logic_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_EQ(refused([](FluidOptions&) {}), "");
  const RheologyOptions mud{FlowLaw::bingham, 10, 0, 1, 0.02};
  EXPECT_TRUE(has(refused([&](FluidOptions& o) { o.rheology = mud, o.smagorinsky = 0.1; }), "Smagorinsky"));
  EXPECT_TRUE(has(
      refused([&](FluidOptions& o) { o.rheology = mud, o.solid_operator = SolidOperator::wall_velocity_bounce_back; }),
      "bounce populations back"));
  EXPECT_TRUE(has(refused([&](FluidOptions& o) {
                    o.rheology = mud;
                    o.domain.walls.add(
                        {.name = "bed", .shape = HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, .slip = WallSlip::wall_model});
                  }),
                  "wall model"));
  EXPECT_TRUE(
      has(refused([&](FluidOptions& o) { o.rheology = mud, o.domain.slip = WallSlip::wall_model; }), "wall model"));
  EXPECT_TRUE(
      has(refused([&](FluidOptions& o) { o.rheology = mud, o.weighting = BodyWeighting::inertial; }), "inertial"));
  EXPECT_TRUE(has(refused([](FluidOptions& o) { o.surface_tension = 0.0728, o.time_step = 0.1; }), "ripples"));
}

}  // namespace
}  // namespace lahar::lbm
