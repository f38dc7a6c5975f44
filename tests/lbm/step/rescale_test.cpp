#include "lbm/step/rescale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "lbm/collision/cell_state.h"
#include "tests/alternatives.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

constexpr double kTau = 0.8, kShear = 1e-5;

struct Incoming {
  Moments<double> m;
  Symmetric<double> s;
};

Incoming incoming(Fluid<double>& fluid, CellPlace place) {
  double f[D3Q19::q];
  f[0] = fluid.grid().block(place.block).f(0)[place.cell];
  for (int a = 1; a < D3Q19::q; a += 2) {
    const auto pair = fluid.grid().access(place, a, fluid.parity());
    f[a] = *pair.incoming_a, f[a + 1] = *pair.incoming_b;
  }
  const Moments<double> m = moments(f);
  return {m, stress(f, m)};
}

/// u_x = 0.03 + shear z with its stress, density 1.01.
void fill_with_shear(Fluid<double>& fluid) {
  fluid.fill_everything([](const Vec3& p) { return Vec3(0.03 + kShear * p.z(), 0, 0); },
                        [](const Vec3&) { return 0.01; }, Start::with_stress);
}

SweepParameters parameters(double tau = kTau) {
  SweepParameters p;
  p.tau = tau;
  p.gravity = {0, 0, -1e-3};
  return p;
}

CellPlace middle(Fluid<double>& fluid) { return {fluid.grid().owned().front(), cell_index(4, 4, 4)}; }

/// Density, velocity, and the stress of the same physical strain rate: S = -2/3 rho tau D, D_xz = shear / 2.
TEST(Rescale, KeepsPressureVelocityAndStrainRate) {
  for (const CollisionOperator& collision : alternatives<CollisionOperator>())
    for (const double r : {0.5, 0.8, 1.25, 3.0}) {
      Fluid<double> fluid(lattice_options(Vec3i::Constant(16), (kTau - 0.5) / 3));
      fill_with_shear(fluid);
      const CellPlace place = middle(fluid);
      const Incoming before = incoming(fluid, place);
      ASSERT_NEAR(before.s.xz, -kTau * 1.01 * kShear / 3, 1e-3 * kShear);
      SweepParameters p = parameters();
      p.collision = collision;
      const double mass = rescale_block(fluid.grid(), place.block, fluid.parity(), p, r);
      const Incoming after = incoming(fluid, place);
      const double tau = 0.5 + r * (kTau - 0.5), rho = std::pow(1.01, r * r);
      EXPECT_NEAR(after.m.drho, rho - 1, 1e-12);
      EXPECT_NEAR(after.m.u[0], r * before.m.u[0], 1e-14);
      EXPECT_NEAR(after.m.u[2], r * before.m.u[2] - 1e-3 * (r - r * r) / 2, 1e-14);
      EXPECT_NEAR(after.s.xz, -tau * rho * r * kShear / 3, 2e-3 * r * tau * kShear);
      EXPECT_NEAR(mass, 512 * (rho - 1.01), 1e-9);
    }
}

/// Where the viscosity depends on the strain rate, so does tau: Bingham far above its yield stress and a Smagorinsky
/// fluid of which most is eddies.
TEST(Rescale, KeepsTheStrainRateWithVariableViscosity) {
  constexpr double r = 2;
  SweepParameters bingham = parameters();
  bingham.rheology = {FlowLaw::bingham, 2e-7, 0.1, 1, 50};
  const double bingham_tau = 0.5 + 3 * (0.1 + 2e-7 / kShear);
  SweepParameters eddies = parameters(0.5001);
  eddies.smagorinsky = 100;  // nu_t = Cs^2 |D| sqrt(2), |D| sqrt(2) = shear
  const double eddy_tau = 0.5001 + 3 * 100.0 * 100.0 * kShear;
  for (const auto& [p, tau] : {std::pair{bingham, bingham_tau}, std::pair{eddies, eddy_tau}}) {
    // The start has the stress of the law's own tau at this strain rate.
    Fluid<double> fluid(lattice_options(Vec3i::Constant(16), (tau - 0.5) / 3));
    fill_with_shear(fluid);
    const CellPlace place = middle(fluid);
    rescale_block(fluid.grid(), place.block, fluid.parity(), p, r);
    const double new_tau = 0.5 + r * (tau - 0.5), rho = std::pow(1.01, r * r);
    EXPECT_NEAR(incoming(fluid, place).s.xz / (-new_tau * rho * r * kShear / 3), 1, 0.02);
  }
}

/// A channel driven by a force is at rest with a new step, whatever the relaxation times: the odd part, by which two of
/// them place the walls, follows from the force.
TEST(Rescale, ADrivenChannelStaysSteady) {
  for (const double r : {0.5, 1.25, 2.0}) {
    FluidOptions o = lattice_options(Vec3i(8, 8, 8), 1.0 / 6);
    o.collision = Trt{};
    o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
    o.gravity = Vec3(1e-6, 0, 0);
    Fluid<double> fluid(o);
    fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, no_pressure);
    for (int s = 0; s < 2000; ++s) fluid.step();
    std::vector<double> before;
    fluid.for_each_wet_cell([&](const WetCell& c) { before.push_back(c.velocity.x()); });
    fluid.set_time_step(r);
    double worst = 0;
    for (int s = 0; s < 100; ++s) {
      fluid.step();
      std::size_t k = 0;
      fluid.for_each_wet_cell(
          [&](const WetCell& c) { worst = std::max(worst, std::abs(c.velocity.x() - before[k++])); });
    }
    EXPECT_LT(worst, 1e-8 * *std::max_element(before.begin(), before.end())) << r;
  }
}

/// A lid that drives a channel goes on at its own speed.
TEST(Rescale, WallsKeepTheirSpeed) {
  for (const WallPlacement placement : {WallPlacement::half_way, WallPlacement::interpolated}) {
    FluidOptions o = lattice_options(Vec3i(8, 8, 12), 0.2);
    o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
    o.domain.placement = placement;
    Wall lid{"lid", HalfSpace{Vec3(0, 0, 12), -Vec3::UnitZ()}, WallSlip::no_slip};
    lid.velocity = Vec3(0.02, 0, 0);
    o.domain.walls.add(lid);
    Fluid<double> fluid(o);
    fluid.fill_everything([](const Vec3& p) { return Vec3(0.02 * p.z() / 12, 0, 0); }, no_pressure, Start::with_stress);
    for (int s = 0; s < 500; ++s) fluid.step();
    for (const double step : {2.0, 0.7}) {
      fluid.set_time_step(step);
      for (int s = 0; s < 300; ++s) fluid.step();
      fluid.for_each_wet_cell([&](const WetCell& c) { EXPECT_NEAR(c.velocity.x(), 0.02 * c.centre.z() / 12, 1e-5); });
    }
  }
}

/// What a held force gives in a step is proportional to the step.
TEST(Rescale, HeldForcesActOverTheNewStep) {
  Fluid<double> fluid(lattice_options(Vec3i::Constant(8), 0.1));
  fluid.fill_everything([](const Vec3&) { return Vec3::Zero().eval(); }, no_pressure);
  const BlockIndex b = fluid.grid().owned().front();
  for (double& impulse : fluid.grid().require_impulse(b).x) impulse = 1e-4;
  fluid.set_time_step(0.5);
  fluid.step();
  fluid.for_each_wet_cell([&](const WetCell& c) { EXPECT_NEAR(c.velocity.x(), 0.5e-4, 1e-12); });
}

struct End {
  double mass_drift, rescaled, time_step;
  std::int64_t changes;
  std::vector<double> fill;
};

template <class Real>
End dam_break(int threads, double lattice_velocity) {
  const ThreadLimit limit(threads);
  FluidOptions o = tank_options(Vec3(0.4, 0.12, 0.3), 0.02, 2.0, lattice_velocity);
  o.adaptive_time_step = true;
  Fluid<Real> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.15, 0.12, 0.22)}});
  while (fluid.time() < 0.6) fluid.step();
  End end{fluid.mass_drift(),
          fluid.rescaled_mass() / fluid.liquid_mass(),
          fluid.units().time_step,
          fluid.time_step_record().changes,
          {}};
  fluid.for_each_wet_cell([&](const WetCell& c) { end.fill.push_back(c.fill_level); });
  return end;
}

/// A first step four times too long and one four times too short: the ledger closes and threads do not matter.
TEST(AdaptiveTimeStep, DamBreakKeepsItsLedger) {
  for (const double lattice_velocity : {0.4, 0.025}) {
    const End one = dam_break<double>(1, lattice_velocity), two = dam_break<double>(2, lattice_velocity);
    EXPECT_GE(one.changes, 1);
    EXPECT_LT(std::abs(one.mass_drift), 1e-10);
    EXPECT_GT(std::abs(one.rescaled), 1e-5);  // or there is nothing to book
    EXPECT_EQ(one.time_step, two.time_step);
    EXPECT_EQ(one.fill, two.fill);
    EXPECT_LT(std::abs(dam_break<float>(1, lattice_velocity).mass_drift), 1e-6);
  }
}

TEST(AdaptiveTimeStep, HydrographBringsItsVolume) {
  FluidOptions o = tank_options(Vec3(0.4, 0.16, 0.2), 0.01, 2.0, 0.02);
  o.adaptive_time_step = true;
  o.inflows.push_back(
      {"source", Vec3(0.1, 0.04, 0), Vec3(0.2, 0.12, 0.1), Vec3::Zero(), {{{0.05, 0.004}, {0.55, 0.004}}}});
  Fluid<double> fluid(o);
  while (fluid.time() < 0.7) fluid.step();
  EXPECT_GE(fluid.time_step_record().changes, 1);
  EXPECT_NEAR(fluid.inflow_mass(), 2.0, 2e-9);
  EXPECT_LT(std::abs(fluid.mass_drift()), 1e-10);
}

}  // namespace
}  // namespace lahar::lbm
