// Free slip along the lattice, off planes at an angle to it, and steps under a moving wall.
#include "lbm/boundary/slip_wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "core/worst.h"
#include "tests/core/shapes.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Flow down a plane under a slipping lid: u = g z (2 H - z) / (2 nu), at a tau far from 1 and at one beyond it. A
/// stress of (1 - tau)/3 times the shear at the lid would change it by a quarter.
TEST(SlipWall, HalfAChannelIsExact) {
  for (const double viscosity : {0.02, 0.3}) {
    const int height = 12;
    FluidOptions o = lattice_options({8, 8, height}, viscosity);
    o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
    o.domain.walls.add({"lid", HalfSpace{Vec3(0, 0, height), -Vec3::UnitZ()}, WallSlip::free_slip});
    const double peak = 0.02, g = 2 * viscosity * peak / (height * height);
    o.gravity = Vec3(g, 0, 0);
    Fluid<double> fluid(o);
    const auto exact = [&](double z) { return g * z * (2 * height - z) / (2 * viscosity); };
    fluid.fill_everything([&](const Vec3& p) { return Vec3(exact(p.z()), 0, 0); }, no_pressure);
    for (int s = 0; s < 3 * height * height / viscosity; ++s) fluid.step();
    fluid.for_each_wet_cell([&](const WetCell& c) {
      EXPECT_NEAR(c.velocity.x() / peak, exact(c.centre.z()) / peak, 0.02) << c.centre.z();
    });
    EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
  }
}

/// Where two slipping walls lie in one plane liquid slides from one to the other: at the seam both held it as a no-slip
/// strip of two cells does.
TEST(SlipWall, WallsInOnePlaneAreOneMirror) {
  FluidOptions o = lattice_options({24, 16, 8}, 5e-6);
  o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  o.domain.slip = WallSlip::free_slip;
  o.domain.walls.add({"patch", SolidBox{Vec3(9, 5, -4), Vec3(14, 11, 0)}, WallSlip::free_slip});
  Fluid<double> fluid(o);
  const Vec3 velocity(0.05, 0.02, 0);
  fluid.fill_everything([&](const Vec3&) { return velocity; }, no_pressure);
  for (int s = 0; s < 50; ++s) fluid.step();
  double off = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) { off = std::max(off, (c.velocity - velocity).norm()); });
  EXPECT_LT(off, 1e-12);
}

/// A slope that falls by less than half a cell in the whole domain leaves the bed as it was, but for its normal: over
/// the bends between it and the level part, and back, a plug slides on. (Both held it as no-slip strips do.)
TEST(SlipWall, LiquidSlidesOverABend) {
  FluidOptions o = lattice_options({32, 8, 16}, 5e-6);
  o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  o.domain.slip = WallSlip::free_slip;
  o.domain.walls.add({"slope", HalfSpace{Vec3(16, 0, 0), Vec3(0.01, 0, 1).normalized()}, WallSlip::free_slip});
  Fluid<double> fluid(o);
  fluid.fill_everything([](const Vec3&) { return Vec3(0.05, 0.02, 0); }, no_pressure);
  for (int s = 0; s < 50; ++s) fluid.step();
  double slowest = 1;
  fluid.for_each_wet_cell([&](const WetCell& c) { slowest = std::min(slowest, c.velocity.x() / 0.05); });
  EXPECT_GT(slowest, 0.97);
}

/// Faces of the domain that slip are walls in their place, and a wall there goes before.
TEST(SlipWall, FacesSlipAsWallsInTheirPlaceDo) {
  const auto sheet = [](WallSlip faces, std::optional<WallSlip> bed) {
    FluidOptions o = lattice_options({32, 8, 12}, 0.01);
    o.domain.faces = {FaceKind::closed,   FaceKind::closed, FaceKind::periodic,
                      FaceKind::periodic, FaceKind::closed, FaceKind::closed};
    o.domain.slip = faces;
    if (bed)
      for (const auto& [point, normal] :
           {std::pair{Vec3(0, 0, 0), Vec3(0, 0, 1)}, std::pair{Vec3(0, 0, 12), Vec3(0, 0, -1)},
            std::pair{Vec3(0, 0, 0), Vec3(1, 0, 0)}, std::pair{Vec3(32, 0, 0), Vec3(-1, 0, 0)}})
        o.domain.walls.add({"wall", HalfSpace{point, normal}, *bed});
    Fluid<double> fluid(o);
    fluid.fill({{Vec3(4, 0, 0), Vec3(20, 8, 4), Vec3(0.05, 0, 0)}});
    for (int s = 0; s < 200; ++s) fluid.step();
    std::vector<double> speeds;
    fluid.for_each_wet_cell([&](const WetCell& c) { speeds.push_back(c.velocity.x()); });
    return speeds;
  };
  const auto slipping = sheet(WallSlip::free_slip, {});
  EXPECT_EQ(slipping, sheet(WallSlip::no_slip, WallSlip::free_slip));
  EXPECT_EQ(slipping, sheet(WallSlip::free_slip, WallSlip::free_slip));
  EXPECT_NE(slipping, sheet(WallSlip::no_slip, {}));
  EXPECT_EQ(sheet(WallSlip::no_slip, {}), sheet(WallSlip::free_slip, WallSlip::no_slip));
}

/// Mean of `of` over all liquid by mass, in lattice units.
template <class Of>
double mass_mean(const Fluid<double>& fluid, const Of& of) {
  double sum = 0, mass = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) {
    const double m = c.liquid_volume * (1 + 3 * c.pressure);
    sum += m * of(c), mass += m;
  });
  return sum / mass;
}

/// A sheet slides over a slipping bed: its centre of mass moves as fast as its momentum says, however thin it is, and
/// it keeps its speed. (Where each cell gets back what it sent, it falls behind by 12 % and 7 %; the open surface
/// leaves 3.)
TEST(SlipWall, LiquidMovesWithItsVelocity) {
  for (const double height : {1.5, 4.0}) {
    FluidOptions o = lattice_options({64, 8, 12}, 0.01);
    o.domain.faces = {FaceKind::open,     FaceKind::open,   FaceKind::periodic,
                      FaceKind::periodic, FaceKind::closed, FaceKind::open};
    o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::free_slip});
    Fluid<double> fluid(o);
    fluid.fill({{Vec3(4, 0, 0), Vec3(28, 8 - 1e-9, height), Vec3(0.05, 0, 0)}});
    double travelled = 0;
    const double start = mass_mean(fluid, [](const WetCell& c) { return c.centre.x(); });
    for (int s = 0; s < 400; ++s) {
      fluid.step();
      travelled += mass_mean(fluid, [](const WetCell& c) { return c.velocity.x(); });
    }
    EXPECT_NEAR((mass_mean(fluid, [](const WetCell& c) { return c.centre.x(); }) - start) / travelled, 1, 0.05)
        << height;
    EXPECT_NEAR(travelled / 20, 1, 0.02) << height;
    EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
  }
}

/// The same down a bed in steps, where no cell lies behind a riser that could fill the front. (Where interface cells
/// got nothing from the steps, it fell behind by 8 % and 4 %.)
TEST(SlipWall, LiquidMovesDownStepsWithItsVelocity) {
  const Vec3 up = Vec3(1, 0, 2).normalized(), along(up.z(), 0, -up.x()), heel(2, 0, 40);
  for (const double height : {4.0, 8.0}) {
    FluidOptions o = lattice_options({72, 8, 64}, 1e-3);
    o.domain.faces.fill(FaceKind::open);
    o.domain.faces[2] = o.domain.faces[3] = FaceKind::periodic;
    o.domain.walls.add({"bed", HalfSpace{heel, up}, WallSlip::free_slip});
    Fluid<double> fluid(o);
    std::vector<LiquidRegion> slices;  // of a sixteenth of a cell
    for (double x = 6; x < 30; x += 1.0 / 16) {
      const double bed = heel.z() - (x + 1.0 / 32 - heel.x()) * up.x() / up.z();
      slices.push_back({Vec3(x, 0, bed), Vec3(x + 1.0 / 16 - 1e-9, 8 - 1e-9, bed + height / up.z()), 0.05 * along});
    }
    fluid.fill(slices);
    double travelled = 0;
    const double start = mass_mean(fluid, [&](const WetCell& c) { return c.centre.dot(along); });
    for (int s = 0; s < 400; ++s) {
      fluid.step();
      travelled += mass_mean(fluid, [&](const WetCell& c) { return c.velocity.dot(along); });
    }
    EXPECT_NEAR((mass_mean(fluid, [&](const WetCell& c) { return c.centre.dot(along); }) - start) / 20, 1, 0.01)
        << height;
    EXPECT_NEAR(travelled / 20, 1, 0.02) << height;
    EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
  }
}

/// A film of 0.8 cells with a hump runs down steps. What its interface cells get over the steps the whole film gives
/// back: the few liquid cells under the hump do not pay for it (they were thrown to 0.35 lu, the wider the film the
/// sooner), and where there are none the ledger closes.
TEST(SlipWall, AFilmWithAHumpRunsDownSteps) {
  const Vec3 up = Vec3(1, 0, 2).normalized(), along(up.z(), 0, -up.x()), heel(2, 0, 24);
  const auto run = [&](int width, bool hump) {
    FluidOptions o = lattice_options({48, width, 32}, 1e-3);
    o.domain.faces.fill(FaceKind::open);
    o.domain.faces[2] = o.domain.faces[3] = FaceKind::periodic;
    o.domain.walls.add({"bed", HalfSpace{heel, up}, WallSlip::free_slip});
    o.gravity = 2e-4 * along;
    Fluid<double> fluid(o);
    std::vector<LiquidRegion> columns;
    for (int x = 6; x < 32; ++x) {
      const double bed = std::ceil(heel.z() - 0.5 * (x + 0.5 - heel.x()) - 0.5);
      const auto fill = [&](double y, double to_y, double level) {
        columns.push_back({Vec3(x, y, bed), Vec3(x + 1, to_y, bed + level), 0.05 * along});
      };
      fill(0, width - 1e-9, 0.8);
      if (hump && x == 16) fill(2, 5, 4);
    }
    fluid.fill(columns);
    double drift = 0, fastest = 0;
    for (int s = 0; s < 60; ++s) {
      fluid.step();
      keep_worst(drift, std::abs(fluid.mass_drift()));
      fluid.for_each_wet_cell([&](const WetCell& c) { keep_worst(fastest, c.velocity.norm()); });
    }
    EXPECT_LT(drift, 1e-12) << width << hump;
    return fastest;
  };
  const double narrow = run(8, true);
  EXPECT_LT(narrow, 0.09);
  EXPECT_NEAR(run(64, true) / narrow, 1, 0.1);
  EXPECT_LT(run(16, false), 0.08);
}

/// A plug between two slipping planes at an angle to the lattice keeps its speed: steps do not brake it.
TEST(SlipWall, StepsDoNotBrake) {
  // A slope of 1 : 2 repeats after two cells, so the channel can be periodic along x and sheared along z by blocks.
  FluidOptions o = lattice_options({64, 8, 64}, 0.01);
  o.domain.faces[0] = o.domain.faces[1] = o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  const Vec3 along = Vec3(2, 0, 1).normalized(), up = Vec3(-1, 0, 2).normalized(), middle(32, 0, 32);
  for (const double side : {-1.0, 1.0})
    o.domain.walls.add({"side", HalfSpace{Vec3(middle + side * 8 * up), Vec3(-side * up)}, WallSlip::free_slip});
  Fluid<double> fluid(o);
  fluid.fill_everything([&](const Vec3&) { return Vec3(0.02 * along); }, no_pressure);
  // Before sound from the channel's ends (28 cells away and more) arrives in the middle.
  for (int s = 0; s < 30; ++s) fluid.step();
  double worst = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) {
    if (std::abs((c.centre - middle).dot(along)) < 4) keep_worst(worst, (c.velocity - 0.02 * along).norm() / 0.02);
  });
  EXPECT_LT(worst, 0.01);
}

/// Dam break over a slipping bed, a slipping ramp and a box that slips: the ledger closes.
TEST(SlipWall, DamBreakKeepsItsMass) {
  FluidOptions o = tank_options(Vec3(0.4, 0.08, 0.3), 0.01, 2.5);
  o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::free_slip});
  o.domain.walls.add({"ramp", HalfSpace{Vec3(0.3, 0, 0), Vec3(-0.6, 0, 1).normalized()}, WallSlip::free_slip});
  o.domain.walls.add({"box", SolidBox{Vec3(0.2, 0.02, -0.1), Vec3(0.24, 0.05, 0.03)}, WallSlip::free_slip});
  Fluid<double> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.1, 0.08, 0.2)}});
  double drift = 0;
  for (int s = 0; s < 1500; ++s) {
    fluid.step();
    if (s % 50 == 0) keep_worst(drift, std::abs(fluid.mass_drift()));
  }
  EXPECT_LT(drift, 1e-10);
}

/// A bed that is level and then rises, as one surface.
Wall bent_bed(double level, double bend, double slope) {
  const Vec3 up_slope = Vec3(-slope, 0, 1).normalized();
  const auto grid = sampled(Vec3(-0.1, -0.1, -0.1), Vec3(0.5, 0.2, 0.4), 0.005, [&](const Vec3& p) {
    const Vec3 from_bend = p - Vec3(bend, 0, level);
    return std::min(from_bend.z(), from_bend.dot(up_slope));
  });
  return {"bed", SampledDistance{grid}, WallSlip::free_slip};
}

/// What crosses the bend by way of the mirror comes from the cell that lost it.
TEST(SlipWall, DamBreakOverABendKeepsItsMass) {
  for (const double slope : {0.3, -0.3}) {
    FluidOptions o = tank_options(Vec3(0.4, 0.08, 0.3), 0.01, 2.5);
    o.domain.walls.add(bent_bed(0.05, 0.2, slope));
    Fluid<double> fluid(o);
    fluid.fill({{Vec3(0, 0, 0.05), Vec3(0.1, 0.08, 0.2)}});
    for (int s = 0; s < 1000; ++s) fluid.step();
    EXPECT_LT(std::abs(fluid.mass_drift()), 1e-10) << slope;
  }
}

/// What the populations of still liquid lack to be exact does not grow over a bend.
TEST(SlipWall, NoiseDiesOverABend) {
  for (const double slope : {0.1, 0.5}) {
    FluidOptions o = lattice_options({32, 8, 24}, 5e-6);
    o.domain.faces[0] = o.domain.faces[1] = o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
    o.domain.slip = WallSlip::free_slip;
    o.domain.walls.add({"slope", HalfSpace{Vec3(16, 0, 0), Vec3(-slope, 0, 1).normalized()}, WallSlip::free_slip});
    Fluid<double> fluid(o);
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> noise(-1e-6, 1e-6);
    fluid.fill_everything([&](const Vec3&) { return Vec3(noise(generator), noise(generator), noise(generator)); },
                          no_pressure);
    for (int s = 0; s < 4000; ++s) fluid.step();
    EXPECT_LT(largest_speed(fluid), 1e-6) << slope;
  }
}

/// Where the domain begins along a periodic axis makes no difference, even in the midst of a sill on a bed.
TEST(SlipWall, WallsGoOnBeyondPeriodicFaces) {
  for (const WallSlip slip : {WallSlip::no_slip, WallSlip::free_slip}) {
    const auto energy = [&](double shift) {
      FluidOptions o = tank_options(Vec3(0.64, 0.08, 0.3), 0.01, 2.5);
      o.domain.faces[0] = o.domain.faces[1] = FaceKind::periodic;
      const auto piece = [&](double from, double to) {
        if (to > from) o.domain.walls.add({"sill", SolidBox{Vec3(from, 0, -1), Vec3(to, 0.08, 0.06)}, slip});
      };
      o.domain.walls.add({"bed", SolidBox{Vec3(0, 0, -1), Vec3(0.64, 0.08, 0.02)}, slip});
      piece(0.4 + shift, std::min(0.64, 0.48 + shift));
      piece(0, 0.48 + shift - 0.64);
      Fluid<double> fluid(o);
      fluid.fill({{Vec3(0.08 + shift, 0, 0.02), Vec3(0.16 + shift, 0.08, 0.2)}});
      for (int s = 0; s < 600; ++s) fluid.step();
      EXPECT_LT(std::abs(fluid.mass_drift()), 1e-10) << shift;
      double sum = 0;
      fluid.for_each_wet_cell([&](const WetCell& c) { sum += c.liquid_volume * c.velocity.squaredNorm(); });
      return sum;
    };
    const double within = energy(0);
    EXPECT_NEAR(energy(0.2) / within, 1, 0.01);  // the sill stands across the face
  }
}

/// In a tank of slipping walls water rests, however full its topmost cells are: what a mirror sends back from the gas
/// beside stands as high as the surface. (At the gas pressure alone it moves at 5e-4 lu.)
TEST(SlipWall, WaterRestsBetweenMirrors) {
  for (const double level : {0.1, 0.5, 0.9}) {
    FluidOptions o = tank_options(Vec3(0.16, 0.16, 0.24), 0.01, 2.0);
    o.domain.slip = WallSlip::free_slip;
    o.kinematic_viscosity = 1e-3;
    Fluid<double> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(0.16, 0.16, 0.15 + 0.01 * level)}});
    for (int s = 0; s < 2000; ++s) fluid.step();
    EXPECT_LT(largest_speed(fluid) * o.time_step / 0.01, 1e-6) << level;
  }
}

}  // namespace
}  // namespace lahar::lbm
