#include "lbm/free_surface/inflow.h"

#include <gtest/gtest.h>

#include "core/check.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

TEST(Hydrograph, VolumeIsTheIntegral) {
  const Hydrograph h{{{1, 0}, {2, 4}, {4, 4}, {5, 0}}};
  EXPECT_EQ(h.volume_until(0.5), 0);
  EXPECT_NEAR(h.volume_until(1.5), 0.5, 1e-15);  // 4 t^2 / 2
  EXPECT_NEAR(h.volume_until(3), 6, 1e-15);
  EXPECT_NEAR(h.volume_until(5), 12, 1e-15);
  EXPECT_NEAR(h.volume_until(50), 12, 1e-15);
  EXPECT_EQ(h.peak(), 4);
}

/// A tank of 0.4 x 0.16 m; the hydrograph brings 2.4 litres in 0.5 s.
FluidOptions filling(const Vec3& lower, const Vec3& upper, const Vec3& velocity) {
  FluidOptions o = tank_options(Vec3(0.4, 0.16, 0.2), 0.01, 2.0);
  o.kinematic_viscosity = 1e-5;
  o.inflows.push_back({"source", lower, upper, velocity, {{{0.05, 0}, {0.15, 0.006}, {0.45, 0.006}, {0.5, 0.0}}}});
  return o;
}
constexpr double kVolume = 0.5 * 0.006 * (0.1 + 0.05) + 0.006 * 0.3;  // m^3

template <class Real>
void expect_filled(Fluid<Real>& fluid, double start, double tolerance) {
  while (fluid.time() < 0.6) {
    fluid.step();
    if (fluid.steps() % 100 == 0) {
      EXPECT_NEAR(fluid.mass_drift(), 0, tolerance);
    }
  }
  EXPECT_NEAR(fluid.inflow_mass() / (1000 * kVolume), 1, 1e-9 + tolerance);
  EXPECT_NEAR((fluid.liquid_mass() + fluid.outflow_mass() - start) / (1000 * kVolume), 1, 1e-6);
}

TEST(Inflow, FillsADryTankToTheVolumeOfItsHydrograph) {
  Fluid<double> fluid(filling(Vec3(0.0, 0.0, 0.0), Vec3(0.04, 0.16, 0.05), Vec3(0.5, 0, 0)));
  expect_filled(fluid, 0, 1e-12);
  EXPECT_EQ(fluid.outflow_mass(), 0);
  double depth_far = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) {
    if (c.centre.x() > 0.3) depth_far += c.liquid_volume / (0.1 * 0.16);
  });
  EXPECT_GT(depth_far, 0.5 * kVolume / (0.4 * 0.16));  // it runs through the tank
}

TEST(Inflow, FeedsUnderWater) {
  Fluid<double> fluid(filling(Vec3(0.15, 0.04, 0.0), Vec3(0.25, 0.12, 0.03), Vec3(0, 0, 0.2)));
  fluid.fill({{Vec3::Zero(), Vec3(0.4, 0.16, 0.06)}});
  expect_filled(fluid, fluid.liquid_mass(), 1e-12);
}

TEST(Inflow, FillsInFloatToo) {
  Fluid<float> fluid(filling(Vec3(0.0, 0.0, 0.0), Vec3(0.04, 0.16, 0.05), Vec3(0.5, 0, 0)));
  expect_filled(fluid, 0, 1e-6);
}

/// What rounding leaves due after the end of a hydrograph, more or less than nothing, is no reason to look for a cell.
TEST(Inflow, EndsInPeaceWhereItsBoxRunsDry) {
  for (const double length : {0.02, 0.04}) {  // wholly beside the wall, and not
    FluidOptions o = filling(Vec3::Zero(), Vec3(length, 0.16, 0.05), Vec3(2, 0, 0));
    o.domain.slip = WallSlip::free_slip;
    o.domain.faces[1] = FaceKind::open;
    Fluid<float> fluid(o);
    while (fluid.time() < 0.9) fluid.step();
    EXPECT_NEAR(fluid.inflow_mass() / (1000 * kVolume), 1, 1e-6) << length;
  }
}

/// Half of the rows have a wall right behind the box.
TEST(Inflow, FeedsEachRowOfTheStream) {
  FluidOptions o = tank_options(Vec3(0.5, 0.16, 0.12), 0.01, 2.0);
  o.domain.slip = WallSlip::free_slip;
  o.domain.walls.add({"sill", SolidBox{Vec3(-1, -1, -1), Vec3(0.1, 0.08, 1)}, WallSlip::free_slip});
  o.inflows.push_back({"sheet", Vec3(0.1, 0, 0), Vec3(0.12, 0.16, 0.03), Vec3(2, 0, 0), {{{0, 0.0064}, {1, 0.0064}}}});
  Fluid<float> fluid(o);
  while (fluid.time() < 0.1) fluid.step();
  double half = 0, all = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) {
    all += c.liquid_volume;
    if (c.centre.y() < 0.08) half += c.liquid_volume;
  });
  EXPECT_NEAR(half / all, 0.5, 0.1);
}

/// The momentum of what comes in: without gravity and walls nearby, that of the mass at the velocity.
TEST(Inflow, BringsItsMomentum) {
  FluidOptions o = filling(Vec3(0.15, 0.04, 0.08), Vec3(0.25, 0.12, 0.14), Vec3(0.4, 0, 0));
  o.gravity = Vec3::Zero();
  Fluid<double> fluid(o);
  while (fluid.time() < 0.2) fluid.step();
  double momentum = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) { momentum += 1000 * c.liquid_volume * c.velocity.x(); });
  EXPECT_NEAR(momentum / (0.4 * fluid.inflow_mass()), 1, 0.02);
}

/// What is due in a step comes all through it: at the end gravity has acted on it for half a step.
TEST(Inflow, ComesInTheMiddleOfTheStep) {
  FluidOptions o = filling(Vec3(0.15, 0.04, 0.08), Vec3(0.25, 0.12, 0.14), Vec3(0.4, 0, 0));
  o.gravity = Vec3(3, 0, 0);
  Fluid<double> fluid(o);
  while (fluid.inflow_mass() == 0) fluid.step();
  int cells = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) {
    EXPECT_NEAR(c.velocity.x(), 0.4 + 0.5 * 3 * fluid.units().time_step, 1e-9);
    ++cells;
  });
  EXPECT_GT(cells, 0);
}

struct Sheet {
  double momentum = 0;  ///< over that of what came in
  double volume = 0;    ///< of what the cells show, over that of what came in: above 1 where some owe
  double depth = 0;     ///< cells, mean behind the front
};

/// A sheet at 4 m/s on a bed without friction, after 0.2 s.
Sheet sheet(double depth, int first, int length) {
  constexpr double cell = 0.02, speed = 4;
  FluidOptions o = tank_options(cell * Vec3(56, 4, 14), cell, speed);
  o.domain.slip = WallSlip::free_slip;
  const double discharge = speed * depth * 4 * cell * cell;
  o.inflows.push_back({"sheet",
                       cell * Vec3(first, 0, 0),
                       cell * Vec3(first + length, 4, std::ceil(depth)),
                       Vec3(speed, 0, 0),
                       {{{0, discharge}, {1, discharge}}}});
  Fluid<float> fluid(o);
  while (fluid.time() < 0.2) fluid.step();
  Sheet found;
  const double came = fluid.inflow_mass() / 1000;
  fluid.for_each_wet_cell([&](const WetCell& c) {
    found.volume += c.liquid_volume / came;
    found.momentum += c.liquid_volume * c.velocity.x() / (speed * came);
    if (c.centre.x() > 12 * cell && c.centre.x() < 28 * cell)
      found.depth += c.liquid_volume / (16 * 4 * std::pow(cell, 3));
  });
  return found;
}

/// Liquid put into full cells made pressure, of which thin cells at the rear take a part: 3 to 10 % of momentum.
TEST(Inflow, SheetsKeepTheMomentumThatComes) {
  for (const double depth : {1.5, 2.2, 4.5}) {
    const Sheet found = sheet(depth, 4, 4);
    EXPECT_NEAR(found.momentum, 1, 0.02) << depth;
    EXPECT_NEAR(found.volume, 1, 0.01) << depth;
    EXPECT_NEAR(found.depth / depth, 1, 0.1) << depth;
  }
}

/// The wall behind the box held a fifth of the momentum.
TEST(Inflow, WallsBehindTheBoxDoNotHoldTheStream) {
  for (const double depth : {2.2, 4.5}) EXPECT_NEAR(sheet(depth, 0, 5).momentum, 1, 0.05) << depth;
}

/// A step that adapts stays so short that the box takes the peak of the discharge.
TEST(Inflow, BoundsTheStepByWhatItsBoxTakes) {
  FluidOptions o = filling(Vec3(0.0, 0.0, 0.0), Vec3(0.04, 0.16, 0.05), Vec3(0.5, 0, 0));
  const double taken = kLargestDose * 0.04 * 0.16 * 0.05;  // m^3 in a step
  o.inflows[0].discharge.points[1].discharge = o.inflows[0].discharge.points[2].discharge = taken / (3 * o.time_step);
  EXPECT_NEAR(time_step_limits(o, Domain(o.domain)).longest / o.time_step, 3, 1e-9);
  o.inflows[0].discharge.points[1].discharge = taken / (0.1 * o.time_step);
  EXPECT_EQ(time_step_limits(o, Domain(o.domain)).longest, o.time_step);
  // What a wall takes of the box takes nothing.
  o.inflows[0].discharge.points[1].discharge = taken / (3 * o.time_step);
  o.domain.walls.add({"block", SolidBox{Vec3(-1, -1, -1), Vec3(0.02, 1, 1)}});
  EXPECT_NEAR(time_step_limits(o, Domain(o.domain)).longest / o.time_step, 1.5, 1e-9);
}

/// What comes while the step changes would be taken for pressure, and scaled: it comes a step later.
TEST(Inflow, WaitsWhileTheStepChanges) {
  for (const double next : {0.5, 1.25}) {
    FluidOptions o;
    o.domain.upper = Vec3::Constant(16);
    o.domain.cell_size = o.time_step = 1;
    o.kinematic_viscosity = 0.1;
    o.domain.faces.fill(FaceKind::periodic);
    o.gravity = Vec3::Zero();
    o.inflows.push_back(
        {"spring", Vec3::Constant(6), Vec3::Constant(10), Vec3::Zero(), {{{0, 1}, {10, 1}}}});  // a cell a step
    Fluid<double> fluid(o);
    fluid.fill_everything([](const Vec3&) { return Vec3::Zero().eval(); }, [](const Vec3&) { return 0.0; });
    const double start = fluid.liquid_mass();
    fluid.set_time_step(next);
    fluid.step();
    EXPECT_NEAR(fluid.rescaled_mass() / start, 0, 1e-12) << next;
    fluid.step();
    fluid.step();
    EXPECT_NEAR((fluid.liquid_mass() - start) / fluid.inflow_mass(), 1, 1e-9) << next;
    EXPECT_GT(fluid.inflow_mass(), 0);
  }
}

/// Three cells along a stream that comes from a wall: the column that is free of it gets what it can take, those at the
/// wall the rest.
TEST(Inflow, ColumnsAtAWallGetOnlyWhatIsLeft) {
  FluidOptions o = tank_options(Vec3(0.4, 0.16, 0.2), 0.01, 2.0);
  o.kinematic_viscosity = 1e-5;
  const double due = 0.25 * 16 * 1e-6;  // m^3 in a step: a quarter of a cell a row
  o.inflows.push_back({"source", Vec3::Zero(), Vec3(0.03, 0.16, 0.05), Vec3(0.5, 0, 0), {}});
  o.inflows[0].discharge = {{{0, due / o.time_step}, {1, due / o.time_step}}};
  Fluid<double> fluid(o);
  fluid.step();
  double at_wall = 0, free = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) { (c.centre.x() < 0.02 ? at_wall : free) += c.liquid_volume; });
  EXPECT_NEAR(free / due, 0.8, 0.05);
  EXPECT_NEAR(at_wall / due, 0.2, 0.05);
}

TEST(Inflow, RefusesWhatItsBoxCannotTake) {
  FluidOptions o = filling(Vec3(0.0, 0.0, 0.0), Vec3(0.01, 0.01, 0.01), Vec3::Zero());
  Fluid<double> fluid(o);
  EXPECT_THROW(for (int s = 0; s < 2000; ++s) fluid.step(), NumericalFailure);
  o.inflows[0].upper = Vec3(0.001, 0.001, 0.001);
  EXPECT_THROW(Fluid<double>{o}, std::logic_error);
}

/// Where a stream brings less than its velocity would the columns at its back run dry: pushed by all of the stream's
/// velocity in a step they made 3 and 24 J.
TEST(Inflow, ALeanStreamBringsNoMoreThanItsEnergy) {
  for (const double lattice_velocity : {0.05, 0.01}) {
    FluidOptions o = tank_options(Vec3(0.8, 0.2, 0.3), 0.02, 2, lattice_velocity);
    o.domain.slip = WallSlip::free_slip;
    o.domain.faces[1] = FaceKind::open;
    o.kinematic_viscosity = 1e-6;
    o.inflows.push_back(
        {"lean", Vec3::Zero(), Vec3(0.1, 0.2, 0.1), Vec3(1, 0, 0), {{{0, 0}, {0.1, 0.01}, {0.2, 0.0}}}});
    Fluid<float> fluid(o);
    double most = 0;
    while (fluid.time() < 0.4) {
      fluid.step();
      if (fluid.steps() % 20 != 0) continue;
      double kinetic = 0;
      fluid.for_each_wet_cell([&](const WetCell& c) { kinetic += 500 * c.liquid_volume * c.velocity.squaredNorm(); });
      most = std::max(most, kinetic);
    }
    EXPECT_NEAR(most, 0.6, 0.15) << lattice_velocity;  // of 1 kg with 1 m/s, and of its fall
  }
}

/// 2.4 litres into a closed box of half a litre.
TEST(Inflow, StopsWhereWhatComesCanFlowOffNowhere) {
  FluidOptions o = filling(Vec3(0.0, 0.0, 0.0), Vec3(0.04, 0.08, 0.04), Vec3(0.5, 0, 0));
  o.domain.upper = Vec3(0.08, 0.08, 0.08);
  o.domain.faces = {};  // all closed
  Fluid<float> fluid(o);
  const double full = 1000 * 0.08 * 0.08 * 0.08;
  EXPECT_THROW(while (fluid.time() < 0.5) fluid.step(), NumericalFailure);
  EXPECT_NEAR(fluid.liquid_mass() / full, 1.5, 0.1);
}

}  // namespace
}  // namespace lahar::lbm
