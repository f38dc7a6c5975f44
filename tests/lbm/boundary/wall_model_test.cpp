#include "lbm/boundary/wall_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

TEST(WallModel, LawHasItsLimits) {
  // Sublayer: nu u / y. Logarithmic layer: u+ = ln(y+)/kappa + B.
  EXPECT_NEAR(wall_stress(1e-4, 0.5, 0.1, 0) / (0.1 * 1e-4 / 0.5), 1, 1e-6);
  for (const double y_plus : {300.0, 3000.0, 1e5}) {
    const double u_plus = std::log(y_plus) / kKarman + kSmoothConstant;  // u_tau = 1
    EXPECT_NEAR(wall_stress(u_plus, y_plus, 1, 0), 1, 0.01) << y_plus;
  }
  // Rough: does not feel the viscosity; a small roughness is smooth; more roughness is more stress.
  EXPECT_NEAR(wall_stress(1, 1, 1e-9, 0.1) / std::pow(kKarman / std::log(1 + 300), 2), 1, 1e-12);
  EXPECT_EQ(wall_stress(1, 1, 1e-3, 1e-9), wall_stress(1, 1, 1e-3, 0));
  EXPECT_GT(wall_stress(1, 1, 1e-6, 0.1), wall_stress(1, 1, 1e-6, 0.01));
  EXPECT_EQ(wall_stress(0, 1, 1e-6, 0.1), 0);
}

TEST(WallModel, SpaldingIsSolved) {
  for (double u_plus = 0.01; u_plus < 40; u_plus *= 1.7) {
    const double nu = 1e-5, u_tau = 0.03, y = spalding_distance(u_plus) * nu / u_tau;
    EXPECT_NEAR(wall_stress(u_plus * u_tau, y, nu, 0) / (u_tau * u_tau), 1, 1e-8) << u_plus;
  }
}

FluidOptions open_channel(int cells, double viscosity, WallSlip slip, double roughness) {
  FluidOptions o = lattice_options({8, 8, cells}, viscosity);
  o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  Wall bed{"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, slip};
  bed.roughness = roughness;
  o.domain.walls.add(bed);
  o.domain.walls.add({"lid", HalfSpace{Vec3(0, 0, cells), -Vec3::UnitZ()}, WallSlip::free_slip});
  return o;
}

double mean_speed(const Fluid<double>& fluid) {
  double sum = 0, n = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) { sum += c.velocity.x(), n += 1; });
  return sum / n;
}

/// A laminar flow between plates feels the wall model as a no-slip wall.
TEST(WallModel, LaminarFlowFeelsNoSlip) {
  const double viscosity = 0.1, push = 1e-6;
  double speed[2];
  for (const WallSlip slip : {WallSlip::no_slip, WallSlip::wall_model}) {
    FluidOptions o = lattice_options({8, 8, 24}, viscosity);
    o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
    o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, slip});
    o.domain.walls.add({"roof", HalfSpace{Vec3(0, 0, 24), -Vec3::UnitZ()}, slip});
    o.gravity = Vec3(push, 0, 0);
    Fluid<double> fluid(o);
    fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, no_pressure);
    for (int s = 0; s < 6000; ++s) fluid.step();
    speed[slip == WallSlip::wall_model] = mean_speed(fluid);
  }
  EXPECT_NEAR(speed[0] / (push * 144 / (3 * viscosity)), 1, 0.01);
  // The law takes the profile as straight up to the cell's centre; its curvature there is 1/24 of a cell's slope.
  EXPECT_NEAR(speed[1] / speed[0], 1, 0.01);
}

/// A layer loses exactly the momentum that the law asks for at the third cell, whatever the cells below do; in a layer
/// of two cells at the second.
TEST(WallModel, LayerLosesTheStressOfTheLaw) {
  const double viscosity = 5e-6, speed = 0.05;
  for (const double roughness : {0.0, 0.3})
    for (const int cells : {2, 16})
      for (const double slow : {1.0, 0.6}) {  // speed of the first cell
        Fluid<double> fluid(open_channel(cells, viscosity, WallSlip::wall_model, roughness));
        fluid.fill_everything([&](const Vec3& p) { return Vec3(p.z() < 1 ? slow * speed : speed, 0, 0); }, no_pressure);
        const double start = mean_speed(fluid), place = cells == 2 ? 1.5 : 2.5;
        double taken = 0;
        for (int s = 0; s < (cells == 2 ? 20 : 400); ++s) {
          fluid.step();
          taken += wall_stress(fluid.cell_at(Vec3(4.5, 4.5, place))->velocity.x(), place, viscosity, roughness);
        }
        EXPECT_NEAR((start - mean_speed(fluid)) * cells / taken, 1, 0.02) << cells << ' ' << slow;
      }
}

/// The same with eddies in the layer, along the wall and across the stream. A wall that stood still across it made them
/// grow and took 3 to 8 times the stress of the law.
TEST(WallModel, EddiesTakeNoMoreThanTheLaw) {
  const double viscosity = 5e-6, speed = 0.05, stirred = 5e-4;
  for (const int cells : {2, 8}) {
    FluidOptions o = open_channel(cells, viscosity, WallSlip::wall_model, 0);
    o.smagorinsky = 0.17;
    Fluid<double> fluid(o);
    fluid.fill_everything(
        [&](const Vec3& p) {
          const Vec3 k = 2 * std::numbers::pi / 8 * p;
          return Vec3(speed + stirred * std::sin(k.y()), stirred * std::sin(2 * k.x()), 0);
        },
        no_pressure);
    const double start = mean_speed(fluid), place = cells == 2 ? 1.5 : 2.5;
    double taken = 0;
    for (int s = 0; s < 2000; ++s) {
      fluid.step();
      double speed_there = 0;
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) speed_there += fluid.cell_at(Vec3(x + 0.5, y + 0.5, place))->velocity.x() / 64;
      taken += wall_stress(speed_there, place, viscosity, 0);
    }
    EXPECT_NEAR((start - mean_speed(fluid)) * cells / taken, 1, 0.1) << cells;
  }
}

/// Flat walls of the wall model brake a vortex by the law, and hand on what moves along them as mirrors do. Sent back,
/// it died as off no-slip walls: 0.54 of its energy was left.
TEST(WallModel, VorticesBetweenFlatWallsLive) {
  const auto energy_left = [](WallSlip slip) {
    FluidOptions o = lattice_options({16, 8, 16}, 5e-6);
    for (const std::size_t face : {0U, 1U, 4U, 5U}) o.domain.faces[face] = FaceKind::closed;
    o.domain.slip = slip;
    Fluid<double> fluid(o);
    fluid.fill_everything(
        [](const Vec3& p) {
          const Vec3 k = std::numbers::pi / 16 * p;
          return Vec3(0.05 * std::sin(k.x()) * std::cos(k.z()), 0, -0.05 * std::cos(k.x()) * std::sin(k.z()));
        },
        no_pressure);
    const auto energy = [&] {
      double sum = 0;
      fluid.for_each_wet_cell([&](const WetCell& c) { sum += c.velocity.squaredNorm(); });
      return sum;
    };
    const double start = energy();
    for (int s = 0; s < 2000; ++s) fluid.step();
    return energy() / start;
  };
  const double between_mirrors = energy_left(WallSlip::free_slip);
  EXPECT_LT(energy_left(WallSlip::no_slip), 0.75 * between_mirrors);
  EXPECT_GT(energy_left(WallSlip::wall_model), 0.9 * between_mirrors);
  EXPECT_LT(energy_left(WallSlip::wall_model), 0.99 * between_mirrors);
}

/// A patch of a bed that slips gets the stress of the law on all of its area, its edges too, and the liquid loses that.
TEST(WallModel, APatchGetsTheStressOfTheLaw) {
  const double viscosity = 5e-6, speed = 0.05, roughness = 0.3;
  FluidOptions o = lattice_options({24, 8, 16}, viscosity);
  o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  o.domain.slip = WallSlip::free_slip;
  Wall patch{"patch", SolidBox{Vec3(9, -4, -4), Vec3(14, 12, 0)}, WallSlip::wall_model};
  patch.roughness = roughness;
  o.domain.walls.add(patch);
  Fluid<double> fluid(o);
  fluid.measure_walls();
  fluid.fill_everything([&](const Vec3&) { return Vec3(speed, 0, 0); }, no_pressure);
  const double start = mean_speed(fluid);
  const int steps = 20;
  for (int s = 0; s < steps; ++s) fluid.step();
  const double got = fluid.wall_loads()[0].impulse.x(), law = wall_stress(speed, 2.5, viscosity, roughness);
  EXPECT_NEAR(got / (5 * 8 * law * steps), 1, 0.02);
  EXPECT_NEAR(got / ((start - mean_speed(fluid)) * 24 * 8 * 16), 1, 1e-5);
}

/// Where viscosity takes as much as bounce-back does the law asks for no more.
TEST(WallModel, ViscousFlowComesToRest) {
  FluidOptions o = lattice_options({24, 16, 16}, 0.3);
  o.domain.faces.fill(FaceKind::closed);
  o.domain.slip = WallSlip::wall_model;
  Fluid<double> fluid(o);
  fluid.fill_everything(
      [](const Vec3& p) { return Vec3(1e-3 * std::sin(p.y()), 1e-3 * std::cos(p.z()), 1e-3 * std::sin(p.x())); },
      no_pressure);
  for (int s = 0; s < 1500; ++s) fluid.step();
  EXPECT_LT(largest_speed(fluid), 1e-6);
}

/// Films that hold a part of a cell lose the stress of the law, whatever that part is.
TEST(WallModel, FilmsLoseTheStressOfTheLaw) {
  const double viscosity = 5e-6;
  for (const double speed : {0.05, 0.12})
    for (const double roughness : {0.0, 0.3})
      for (const double fill : {0.3, 0.5, 0.8}) {
        FluidOptions o = open_channel(8, viscosity, WallSlip::wall_model, roughness);
        o.domain.faces[5] = FaceKind::open;
        Fluid<double> fluid(o);
        fluid.fill({{Vec3::Zero(), Vec3(8, 8, fill), Vec3(speed, 0, 0)}});
        const auto momentum = [&] {
          double sum = 0;
          fluid.for_each_wet_cell([&](const WetCell& c) { sum += c.liquid_volume * c.velocity.x() / 64; });
          return sum;
        };
        const double start = momentum();
        double taken = 0;
        for (int s = 0; s < 20; ++s) {
          fluid.step();
          taken += wall_stress(fluid.cell_at(Vec3(4.5, 4.5, 0.5))->velocity.x(), 0.5, viscosity, roughness);
        }
        EXPECT_NEAR((start - momentum()) / taken, 1, 0.1) << speed << ' ' << roughness << ' ' << fill;
      }
}

/// Flow along y over a bed that is tilted about y: the wall is a staircase, the stress is that of the law at its cells.
TEST(WallModel, ObliqueWallTakesTheStressOfTheLaw) {
  const double viscosity = 5e-6, speed = 0.05, roughness = 0.3;
  FluidOptions o = lattice_options({40, 8, 40}, viscosity);
  o.domain.faces[0] = o.domain.faces[1] = o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  const Vec3 n = Vec3(-1, 0, 2).normalized(), t(n.z(), 0, -n.x()), middle(20, 0, 20);
  Wall bed{"bed", HalfSpace{Vec3(middle - 8 * n), n}, WallSlip::wall_model};
  bed.roughness = roughness;
  o.domain.walls.add(bed);
  for (const Vec3& side : {Vec3(n), Vec3(t), Vec3(-t)})
    o.domain.walls.add({"side", HalfSpace{Vec3(middle + 8 * side), Vec3(-side)}, WallSlip::free_slip});
  Fluid<double> fluid(o);
  fluid.fill_everything([&](const Vec3&) { return Vec3(0, speed, 0); }, no_pressure);
  const auto momentum = [&] {
    double sum = 0;
    fluid.for_each_wet_cell([&](const WetCell& c) { sum += c.velocity.y(); });
    return sum;
  };
  const double before = momentum();
  const int steps = 20;
  for (int s = 0; s < steps; ++s) fluid.step();
  const double area = 16 * 8, law = wall_stress(speed, 0.5, viscosity, roughness);
  EXPECT_NEAR((before - momentum()) / (area * law * steps), 1, 0.1);
}

/// The same flow in a box whose walls lie along the lattice and in one that is turned: beside steps the wall model
/// brakes as flat walls do, eddies or not. (The law is that of the cell at the wall in one, of the third in the other.)
TEST(WallModel, FlowBesideStepsIsBrakedAsOnFlatWalls) {
  const auto lost = [](double slope) {
    const Vec3 up = Vec3(-slope, 0, 1).normalized(), along(up.z(), 0, -up.x()), middle(20, 0, 20);
    FluidOptions o = lattice_options({40, 8, 40}, 5e-6);
    for (const std::size_t face : {0U, 1U, 4U, 5U}) o.domain.faces[face] = FaceKind::closed;
    o.smagorinsky = 0.17;
    for (const Vec3& side : {Vec3(up), Vec3(-up), Vec3(along), Vec3(-along)})
      o.domain.walls.add({"side", HalfSpace{Vec3(middle + 8 * side), Vec3(-side)}, WallSlip::wall_model});
    Fluid<double> fluid(o);
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> noise(-5e-4, 5e-4);
    fluid.fill_everything(
        [&](const Vec3&) { return Vec3(noise(generator), 0.05 + noise(generator), noise(generator)); }, no_pressure);
    const auto speed = [&] {
      double sum = 0, cells = 0;
      fluid.for_each_wet_cell([&](const WetCell& c) { sum += c.velocity.y(), ++cells; });
      return sum / cells;
    };
    const double start = speed();
    for (int s = 0; s < 2000; ++s) fluid.step();
    return start - speed();
  };
  const double flat = lost(0);
  for (const double slope : {0.1, 0.5}) EXPECT_NEAR(lost(slope) / flat, 1, 0.15) << slope;
}

/// Down steps a sheet loses no more than a few times what the law asks for in 400 steps, 3 %. (Two fifths of its speed
/// were gone, as on no-slip walls.)
TEST(WallModel, SheetsSlideDownSteps) {
  for (const double slope : {0.5, 0.2}) {
    const Vec3 up = Vec3(slope, 0, 1).normalized(), along(up.z(), 0, -up.x()), heel(2, 0, slope > 0.3 ? 40 : 24);
    FluidOptions o = lattice_options({72, 8, slope > 0.3 ? 64 : 48}, 1e-4);
    o.domain.faces.fill(FaceKind::open);
    o.domain.faces[2] = o.domain.faces[3] = FaceKind::periodic;
    o.domain.walls.add({"bed", HalfSpace{heel, up}, WallSlip::wall_model});
    o.smagorinsky = 0.17;
    o.gravity = -1e-4 * up;
    Fluid<double> fluid(o);
    std::vector<LiquidRegion> slices;  // of a sixteenth of a cell
    for (double x = 6; x < 30; x += 1.0 / 16) {
      const double bed = heel.z() - (x + 1.0 / 32 - heel.x()) * slope;
      slices.push_back({Vec3(x, 0, bed), Vec3(x + 1.0 / 16 - 1e-9, 8 - 1e-9, bed + 3 / up.z()), 0.05 * along});
    }
    fluid.fill(slices);
    for (int s = 0; s < 400; ++s) fluid.step();
    double sum = 0, volume = 0;
    fluid.for_each_wet_cell(
        [&](const WetCell& c) { sum += c.liquid_volume * c.velocity.dot(along), volume += c.liquid_volume; });
    EXPECT_GT(sum / volume / 0.05, 0.93) << slope;
    EXPECT_LT(sum / volume / 0.05, 1.01) << slope;
  }
}

}  // namespace
}  // namespace lahar::lbm
