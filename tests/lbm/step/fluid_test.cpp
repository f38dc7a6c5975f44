// Flows without a surface against exact solutions.
#include "lbm/step/fluid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/check.h"
#include "core/parallel.h"
#include "tests/alternatives.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Viscosity from the decay of a two-dimensional Taylor-Green vortex, E(t) = E0 exp(-4 nu k^2 t).
double measured_viscosity(int cells, double viscosity, CollisionOperator collision, const Vec3& drift, int steps) {
  FluidOptions o = lattice_options({cells, cells, 8}, viscosity);
  o.collision = collision;
  Fluid<double> fluid(o);
  const double k = 2 * std::numbers::pi / cells, u0 = 0.01;
  fluid.fill_everything(
      [&](const Vec3& p) {
        return Vec3(drift + Vec3(u0 * std::cos(k * p.x()) * std::sin(k * p.y()),
                                 -u0 * std::sin(k * p.x()) * std::cos(k * p.y()), 0));
      },
      [&](const Vec3& p) { return -0.75 * u0 * u0 * (std::cos(2 * k * p.x()) + std::cos(2 * k * p.y())); });
  const auto energy = [&] {
    double e = 0;
    fluid.for_each_wet_cell([&](const WetCell& c) { e += (c.velocity - drift).squaredNorm(); });
    return e;
  };
  for (int s = 0; s < steps / 4; ++s) fluid.step();  // the stress has to build up first
  const double start = energy();
  for (int s = 0; s < steps; ++s) fluid.step();
  return -std::log(energy() / start) / (4 * k * k * steps);
}

class Viscosity : public testing::TestWithParam<CollisionOperator> {};

TEST_P(Viscosity, IsWhatWasAskedFor) {
  EXPECT_NEAR(measured_viscosity(64, 0.02, GetParam(), Vec3::Zero(), 400) / 0.02, 1, 0.01);
}

TEST_P(Viscosity, DoesNotDependOnTheMotionOfTheFrame) {
  const double rest = measured_viscosity(32, 0.02, GetParam(), Vec3::Zero(), 320);
  const double moving = measured_viscosity(32, 0.02, GetParam(), Vec3(0.1, 0, 0), 320);
  // D3Q19 loses 9/4 u^2 of the viscosity of this flow; the default operator puts it back.
  EXPECT_NEAR(moving / rest, 1, std::holds_alternative<CentralMoments>(GetParam()) ? 0.003 : 0.03);
}

INSTANTIATE_TEST_SUITE_P(Operators, Viscosity, testing::ValuesIn(alternatives<CollisionOperator>()),
                         [](const auto& tested) { return std::string(name(tested.param)); });

TEST(Viscosity, ConvergesWithSecondOrder) {
  // Diffusive scaling: same physical time, four times the steps on half the cells.
  const double coarse = measured_viscosity(16, 0.05, CentralMoments{}, Vec3::Zero(), 40) / 0.05 - 1;
  const double fine = measured_viscosity(32, 0.05, CentralMoments{}, Vec3::Zero(), 160) / 0.05 - 1;
  EXPECT_GT(std::log2(std::abs(coarse / fine)), 1.8);
}

/// Plane Poiseuille flow between half-way walls: u = g z (H - z) / (2 nu).
TEST(Fluid, PoiseuilleProfile) {
  FluidOptions o = lattice_options({8, 8, 14}, 0.1);
  o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  const double g = 1e-5, height = 14;
  o.gravity = Vec3(g, 0, 0);
  o.collision = Trt{};  // magic parameter 3/16: the wall is exactly half-way
  Fluid<double> fluid(o);
  fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, no_pressure);
  for (int s = 0; s < 8000; ++s) fluid.step();
  const double peak = g * height * height / (8 * 0.1);
  fluid.for_each_wet_cell([&](const WetCell& c) {
    const double z = c.centre.z(), exact = g * z * (height - z) / (2 * 0.1);
    EXPECT_NEAR(c.velocity.x() / peak, exact / peak, 2e-3);
    EXPECT_NEAR(c.velocity.y(), 0, 1e-12);
  });
}

/// Couette flow: the lower wall moves, the upper stands.
TEST(Fluid, CouetteProfile) {
  FluidOptions o = lattice_options({8, 8, 10}, 0.15);
  o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  const double u = 0.02, height = 10;
  Wall moving{"belt", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}};
  moving.velocity = Vec3(u, 0, 0);
  o.domain.walls.add(moving);
  Fluid<double> fluid(o);
  fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, no_pressure);
  for (int s = 0; s < 4000; ++s) fluid.step();
  fluid.for_each_wet_cell([&](const WetCell& c) { EXPECT_NEAR(c.velocity.x() / u, 1 - c.centre.z() / height, 5e-3); });
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
}

/// Noise in a fluid at rest must die out, however small the viscosity (see lbm/collision/central_moments.h).
TEST(Fluid, NoiseDoesNotGrowAtVanishingViscosity) {
  Fluid<float> fluid(lattice_options({16, 16, 16}, 1e-6));
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  fluid.fill_everything([&](const Vec3&) { return Vec3(0.02 * Vec3(normal(random), normal(random), normal(random))); },
                        no_pressure);
  const double start = largest_speed(fluid);
  for (int s = 0; s < 1500; ++s) fluid.step();
  EXPECT_LT(largest_speed(fluid), 0.5 * start);
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-6);
}

TEST(Fluid, FreeSlipWallFeelsNoShear) {
  FluidOptions o = lattice_options({8, 8, 14}, 0.1);
  o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  o.domain.walls.add({"floor", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::free_slip});
  o.domain.walls.add({"lid", HalfSpace{Vec3(0, 0, 14), -Vec3::UnitZ()}, WallSlip::free_slip});
  Fluid<double> fluid(o);
  fluid.fill_everything([](const Vec3&) { return Vec3(0.03, 0.01, 0); }, no_pressure);
  for (int s = 0; s < 500; ++s) fluid.step();
  fluid.for_each_wet_cell([&](const WetCell& c) { EXPECT_NEAR((c.velocity - Vec3(0.03, 0.01, 0)).norm(), 0, 1e-12); });
}

/// A blow-up is reported with the place, the step and the cause, and not hidden.
TEST(Fluid, BlowUpIsNamed) {
  FluidOptions o = lattice_options({16, 16, 16}, 1e-7);
  o.collision = Bgk{};  // known to diverge here
  Fluid<float> fluid(o);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  fluid.fill_everything([&](const Vec3&) { return Vec3(0.1 * Vec3(normal(random), normal(random), normal(random))); },
                        no_pressure);
  try {
    for (int s = 0; s < 5000; ++s) fluid.step();
    FAIL() << "BGK at nu = 1e-7 was expected to diverge";
  } catch (const NumericalFailure& failure) {
    EXPECT_NE(failure.where().find("fluid cell at ("), std::string::npos);
    EXPECT_GT(failure.step(), 0);
    EXPECT_FALSE(failure.cause().empty());
  }
}

}  // namespace
}  // namespace lahar::lbm
