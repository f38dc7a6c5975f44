// A fluid that was stored and loaded goes on with the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/check.h"
#include "core/memory_archive.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// A dam break that has splashed against the far wall.
FluidOptions dam() {
  FluidOptions o = tank_options(Vec3(0.8, 0.16, 0.5), 0.02, 3.0, 0.1);
  o.smagorinsky = 0.1;
  return o;
}

const std::vector<LiquidRegion> kColumn{{Vec3::Zero(), Vec3(0.2, 0.16, 0.35)}};

template <class Real>
void run(Fluid<Real>& fluid, int steps) {
  for (int s = 0; s < steps; ++s) fluid.step();
}

/// Runs `before` steps, stores, loads into a fluid that was never filled, runs both on, and compares all state.
template <class Real>
void expect_same_after_restart(const FluidOptions& options, const std::vector<LiquidRegion>& liquid, int before,
                               bool measured = false) {
  Fluid<Real> whole(options), resumed(options);
  whole.fill(liquid);
  if (measured) whole.measure_walls();
  run(whole, before);
  StoredState state = state_of(whole);
  load_state(state, resumed);
  EXPECT_TRUE(differing_lists(state, state_of(resumed)).empty()) << "what was loaded is not what was stored";
  EXPECT_EQ(whole.liquid_mass(), resumed.liquid_mass());
  run(whole, 301);
  run(resumed, 301);
  const auto differing = differing_lists(state_of(whole), state_of(resumed));
  EXPECT_TRUE(differing.empty()) << testing::PrintToString(differing);
  EXPECT_EQ(whole.mass_drift(), resumed.mass_drift());
}

template <class Real>
class FluidTransfer : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(FluidTransfer, Precisions);

TYPED_TEST(FluidTransfer, GoesOnMidSplash) { expect_same_after_restart<TypeParam>(dam(), kColumn, 601); }

TYPED_TEST(FluidTransfer, GoesOnWithInterpolatedWallsThatAreMeasured) {
  FluidOptions o = dam();
  o.domain.placement = WallPlacement::interpolated;
  o.domain.walls.add({"pillar", SolidCylinder{Vec3(0.45, 0.07, -1), Vec3(0.45, 0.07, 1), 0.047}});
  expect_same_after_restart<TypeParam>(o, kColumn, 450, true);
}

TYPED_TEST(FluidTransfer, GoesOnWhileLiquidComesInAndLeaves) {
  FluidOptions o = dam();
  o.domain.faces[1] = FaceKind::open;
  o.inflows.push_back({"spring", Vec3(0.02, 0.02, 0), Vec3(0.1, 0.1, 0.1), Vec3(0.5, 0, 0), {{{0, 0.01}, {1, 0.01}}}});
  expect_same_after_restart<TypeParam>(o, kColumn, 401);
}

TYPED_TEST(FluidTransfer, GoesOnAcrossPeriodicFaces) {
  FluidOptions o = dam();
  o.domain.faces[2] = o.domain.faces[3] = FaceKind::periodic;
  expect_same_after_restart<TypeParam>(o, kColumn, 400);
}

/// Lattice velocities of walls follow from those in m/s, however often the step has changed.
TYPED_TEST(FluidTransfer, GoesOnBesideWallsThatMoveAsTheStepAdapts) {
  FluidOptions o = dam();
  o.adaptive_time_step = true;
  o.time_step *= 4;  // it is cut
  o.domain.placement = WallPlacement::interpolated;
  Wall roller{"roller", SolidCylinder{Vec3(0.45, -1, 0.05), Vec3(0.45, 1, 0.05), 0.047}};
  roller.angular_velocity = Vec3(0, 11.3, 0);
  roller.centre = Vec3(0.45, 0, 0.05);
  o.domain.walls.add(roller);
  Wall belt{"belt", HalfSpace{Vec3(0, 0, 0.013), Vec3::UnitZ()}};
  belt.velocity = Vec3(0.3, 0.1, 0);
  o.domain.walls.add(belt);
  Fluid<TypeParam> fluid(o);
  fluid.fill(kColumn);
  run(fluid, 601);
  ASSERT_GE(fluid.time_step_record().changes, 1);
  expect_same_after_restart<TypeParam>(o, kColumn, 601);
}

TEST(FluidState, StoresBlocksThatWereUsedAgain) {
  // Only then are indices another order than that in space, and must come back as they were: others hold them.
  Fluid<double> fluid(dam());
  fluid.fill(kColumn);
  run(fluid, 601);
  const auto& owned = fluid.grid().owned();
  EXPECT_FALSE(std::is_sorted(owned.begin(), owned.end()));
}

TEST(FluidState, RefusesWallsOfAnotherScene) {
  Fluid<double> fluid(dam());
  fluid.fill(kColumn);
  StoredState state = state_of(fluid);
  FluidOptions o = dam();
  o.domain.walls.add({"step", SolidBox{Vec3(0, 0, -1), Vec3(0.1, 1, 0.1)}});
  Fluid<double> other(o);
  EXPECT_THROW(load_state(state, other), ArchiveError);
}

TEST(FluidState, DoesNotStoreWhatIsNotANumber) {
  Fluid<double> fluid(dam());
  fluid.fill(kColumn);
  fluid.grid().block(fluid.grid().owned().front()).f(3)[77] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)state_of(fluid), NumericalFailure);
}

TEST(FluidState, LoadsIntoAnEmptyFluidOnly) {
  Fluid<double> fluid(dam());
  fluid.fill(kColumn);
  StoredState state = state_of(fluid);
  EXPECT_THROW(load_state(state, fluid), std::logic_error);
}

}  // namespace
}  // namespace lahar::lbm
