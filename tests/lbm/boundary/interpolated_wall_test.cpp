// Walls at their own place: order of accuracy where the wall is not half-way between cells, mass, and rest.
#include <gtest/gtest.h>

#include <cmath>

#include "lbm/boundary/wall_reflection.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Relative error (L2) of the flow between two plates at z = 1.31 and 1.31 + H with H = 0.83 x cells: the wall cuts the
/// links at shares that change with the grid. Driven by a force (Poiseuille) or by the upper plate (Couette).
double channel_error(int cells, WallPlacement placement, bool poiseuille) {
  const double viscosity = 0.1, lower = 1.31, height = cells * 0.83, upper = lower + height, u0 = 0.64 / cells;
  FluidOptions o = lattice_options({8, 8, cells + 8}, viscosity);
  o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  o.domain.placement = placement;
  o.collision = Trt{};
  o.domain.walls.add({"lower", HalfSpace{Vec3(0, 0, lower), Vec3::UnitZ()}});
  Wall top{"upper", HalfSpace{Vec3(0, 0, upper), -Vec3::UnitZ()}};
  if (!poiseuille) top.velocity = Vec3(u0, 0, 0);
  o.domain.walls.add(top);
  const double push = 8 * viscosity * u0 / (height * height);
  if (poiseuille) o.gravity = Vec3(push, 0, 0);
  Fluid<double> fluid(o);
  const auto exact = [&](double z) {
    const double s = (z - lower) / height;
    return poiseuille ? 4 * u0 * s * (1 - s) : u0 * s;
  };
  // From the exact flow only the error has to settle.
  fluid.fill_everything([&](const Vec3& p) { return Vec3(exact(p.z()), 0, 0); }, no_pressure);
  for (int s = 0; s < 2 * height * height / viscosity; ++s) fluid.step();
  double error = 0, norm = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) {
    error += std::pow(c.velocity.x() - exact(c.centre.z()), 2);
    norm += std::pow(exact(c.centre.z()), 2);
  });
  return std::sqrt(error / norm);
}

TEST(InterpolatedWall, CouetteIsExact) {
  EXPECT_LT(channel_error(8, WallPlacement::interpolated, false), 1e-6);  // shares are stored as float
  EXPECT_GT(channel_error(8, WallPlacement::half_way, false), 1e-2);
}

TEST(InterpolatedWall, PoiseuilleIsOfSecondOrder) {
  const double coarse = channel_error(8, WallPlacement::interpolated, true),
               fine = channel_error(32, WallPlacement::interpolated, true);
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.8) << coarse << " " << fine;
  const double rough = channel_error(8, WallPlacement::half_way, true);
  EXPECT_GT(rough, 5 * coarse);
}

struct RingError {
  double velocity, drift, returned;
};

/// Flow between a standing outer cylinder of radius 2 r and an inner one of radius r that turns: u = A R + B / R.
RingError ring_error(double r, WallPlacement placement) {
  const double viscosity = 0.1, outer = 2 * r, u0 = 0.48 / r;
  const int cells = 2 * static_cast<int>(std::ceil(outer)) + 4;
  FluidOptions o = lattice_options({cells, cells, 8}, viscosity);
  for (int face = 0; face < 4; ++face) o.domain.faces[static_cast<std::size_t>(face)] = FaceKind::closed;
  o.domain.placement = placement;
  const Vec3 centre(cells / 2.0 + 0.17, cells / 2.0 - 0.23, 0), up(0, 0, 8);
  Wall inner{"inner", SolidCylinder{centre - up, centre + 2 * up, r}};
  inner.angular_velocity = Vec3(0, 0, u0 / r);
  inner.centre = centre;
  o.domain.walls.add(inner);
  o.domain.walls.add({"outer", SolidCylinder{centre - up, centre + 2 * up, outer, true}});
  Fluid<double> fluid(o);
  const double a = -u0 * r / (outer * outer - r * r), b = -a * outer * outer;
  const auto exact = [&](const Vec3& p) {
    const Vec3 d(p.x() - centre.x(), p.y() - centre.y(), 0);
    const double u = a + b / d.squaredNorm();
    return Vec3(-u * d.y(), u * d.x(), 0);
  };
  fluid.fill_everything(exact, no_pressure);
  for (int s = 0; s < 1.5 * r * r / viscosity; ++s) fluid.step();
  double error = 0, norm = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) {
    error += (c.velocity - exact(c.centre)).squaredNorm();
    norm += exact(c.centre).squaredNorm();
  });
  return {std::sqrt(error / norm), fluid.mass_drift(),
          fluid.account().walls.returned * fluid.units().mass() / fluid.liquid_mass()};
}

TEST(InterpolatedWall, CircularCouetteIsOfSecondOrder) {
  const auto order = [](WallPlacement placement, double& fine) {
    const RingError coarse = ring_error(5.3, placement), finer = ring_error(10.6, placement);
    EXPECT_NEAR(coarse.drift, 0, 1e-12);
    EXPECT_NEAR(finer.drift, 0, 1e-12);
    fine = finer.velocity;
    return std::log2(coarse.velocity / finer.velocity);
  };
  double half_way = 0, interpolated = 0;
  const double first = order(WallPlacement::half_way, half_way),
               second = order(WallPlacement::interpolated, interpolated);
  EXPECT_GT(second, 1.7);
  EXPECT_LT(first, 1.4);
  EXPECT_LT(interpolated, 0.25 * half_way);
}

/// Water over walls that cut the links anywhere: gravity does not push it through. Largest speed after 3000 steps.
double speed_at_rest(WallPlacement placement) {
  FluidOptions o = tank_options(Vec3(0.2, 0.08, 0.2), 0.01, 2.0);
  o.kinematic_viscosity = 1e-4;
  o.domain.placement = placement;
  o.domain.walls.add({"bed", HalfSpace{Vec3(0, 0, 0.0137), Vec3::UnitZ()}});
  o.domain.walls.add({"ramp", HalfSpace{Vec3(0.12, 0, 0), Vec3(-0.6, 0, 1).normalized()}});
  Fluid<double> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.2, 0.08, 0.12)}});
  for (int s = 0; s < 3000; ++s) fluid.step();
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
  return largest_speed(fluid);
}

TEST(InterpolatedWall, WaterAtRestStaysAndKeepsItsMass) {
  // m/s, of a wave speed of 1: what the cut links leave of a current.
  EXPECT_LT(speed_at_rest(WallPlacement::half_way), 1e-6);
  EXPECT_LT(speed_at_rest(WallPlacement::interpolated), 1e-5);
}

/// A dam break over an oblique wall, interpolated: the ledger closes.
TEST(InterpolatedWall, DamBreakKeepsItsMass) {
  FluidOptions o = tank_options(Vec3(0.4, 0.08, 0.3), 0.01, 2.5);
  o.domain.placement = WallPlacement::interpolated;
  o.domain.walls.add({"ramp", HalfSpace{Vec3(0.2, 0, 0), Vec3(-0.6, 0, 1).normalized()}});
  o.domain.walls.add({"ball", SolidSphere{Vec3(0.2, 0.04, 0.02), 0.035}});
  Fluid<double> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.1, 0.08, 0.2)}});
  for (int s = 0; s < 1500; ++s) fluid.step();
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
  EXPECT_GT(fluid.account().walls.returned, 0);
}

}  // namespace
}  // namespace lahar::lbm
