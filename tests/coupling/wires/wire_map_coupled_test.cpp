// Resolved wires in the coupled step: audits, the switch by diameter, breakage, threads, checkpoints.
#include <gtest/gtest.h>

#include <memory>

#include "core/memory_archive.h"
#include "core/parallel.h"
#include "coupling/coupled_step.h"
#include "tests/coupling/chains.h"

namespace lahar::coupling {
namespace {

const std::vector<lbm::LiquidRegion> kWater{{Vec3::Zero(), Vec3(0.4, 0.4, 0.24)}};

lbm::FluidOptions small_tank() { return by_distance(tank(Vec3(0.4, 0.4, 0.48), 0.02, 2e-4)); }

dem::Solids solids_of(Chains c, const Vec3& gravity) {
  dem::SolidsOptions options;
  options.gravity = gravity;
  options.time_step = 1;  // set by the coupled step
  options.watchdog.overlap_limit = 1;
  Walls walls;
  walls.add({"floor", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  return {std::move(c.particles), std::move(c.bonds), rock(), std::move(walls), options};
}

/// A cable of 4 cells that is held at its ends under the surface, a ring of 3 cells that falls on it from above, a thin
/// ring in the water, and a stone among them.
Chains scene_of_wires() {
  Chains c;
  c.add(straight_line(Vec3(0.21, 0.04, 0.2), Vec3(0.2, 0.36, 0.21), 5), 0.08, false, dem::ParticleState::free);
  for (const std::size_t end : {0, 4})
    c.particles.state[end] = dem::ParticleState::fixed, c.particles.inverse_mass[end] = 0;
  c.add(circle(Vec3(0.2, 0.2, 0.34), Vec3(0.1, 0.2, 0.97).normalized(), 0.24, 12), 0.06, true,
        dem::ParticleState::free);
  c.add(circle(Vec3(0.1, 0.3, 0.08), Vec3::UnitZ(), 0.1, 30), 0.01, true, dem::ParticleState::free);
  c.particles.add(grain(Vec3(0.29, 0.1, 0.16), 0.04, 2500));
  return c;
}

template <class Real>
std::unique_ptr<CoupledStep<Real>> coupled(double resolve_from) {
  const auto fluid = small_tank();
  CouplingOptions options;
  options.substeps = 20;
  options.mapped_wires = MappedWires{resolve_from};
  return std::make_unique<CoupledStep<Real>>(fluid, solids_of(scene_of_wires(), fluid.gravity), options);
}

template <class Real>
double solid_at(CoupledStep<Real>& step, const Vec3& place) {
  double solid = -1;
  const double half = step.fluid()->units().cell_size / 2;
  step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) {
    if ((c.centre - place).cwiseAbs().maxCoeff() < half) solid = c.solid_fraction;
  });
  return solid;
}

/// Water that hits a wire gives it little more than it loses: the cells in the wire that turn wet bring little of their
/// own (1.7 times as much where they have their neighbours' velocity).
TEST(ResolvedWiresInTheStep, ASlamIsWhatTheWaterLoses) {
  Chains c;
  c.add(straight_line(Vec3(0.2, 0.02, 0.24), Vec3(0.2, 0.38, 0.24), 5), 0.1, false);
  auto fluid = small_tank();
  fluid.gravity = Vec3::Zero();
  CouplingOptions options;
  options.substeps = 20;
  options.mapped_wires = MappedWires{2.5};
  CoupledStep<double> step(fluid, solids_of(std::move(c), fluid.gravity), options);
  constexpr double speed = 5;
  step.fill({{.lower = Vec3(0.04, 0.1, 0.16), .upper = Vec3(0.12, 0.3, 0.32), .velocity = {speed, 0, 0}}});
  const double before = step.liquid_momentum().x();
  double given = 0;
  while (step.time() < 0.02) {
    step.advance();
    const dem::Particles& p = step.solids()->particles();
    for (std::size_t i = 0; i < p.size(); ++i) given += step.time_step() * p.external_force.x[i];
  }
  const double lost = before - step.liquid_momentum().x();
  ASSERT_GT(lost, 0.2 * before);
  EXPECT_GT(given / lost, 0.9);
  EXPECT_LT(given / lost, 1.55);
}

/// What it displaces after a step is to the bit what the next one finds: nothing drifts in single precision.
TEST(ResolvedWiresInTheStep, AWireThatStandsStillDisplacesNoMore) {
  Chains c;
  c.add(straight_line(Vec3(0.21, 0.04, 0.1), Vec3(0.2, 0.36, 0.11), 5), 0.08, false);
  const auto fluid = small_tank();
  CouplingOptions options;
  options.substeps = 20;
  options.mapped_wires = MappedWires{2.5};
  CoupledStep<float> step(fluid, solids_of(std::move(c), fluid.gravity), options);
  step.fill(kWater);
  step.advance();
  const double pool = step.fluid()->account().pool, nearby = step.fluid()->account().paid_nearby;
  for (int s = 0; s < 300; ++s) step.advance();
  EXPECT_EQ(step.fluid()->account().pool, pool);
  EXPECT_EQ(step.fluid()->account().paid_nearby, nearby);
}

TEST(ResolvedWiresInTheStep, MomentumAndLiquidAreKept) {
  const auto step = coupled<double>(2.5);
  step->fill(kWater);
  EXPECT_NEAR(step->fluid()->mass_drift(), 0, 1e-14);
  const double before = step->solids()->particles().position.z[8];
  for (int s = 0; s < 800; ++s) {
    if (s == 500) step->solids()->bonds().intact[1] = 0;  // of the cable
    if (s == 600) step->solids()->bonds().intact[8] = 0;  // of the ring that falls
    step->advance();
  }
  EXPECT_LT(step->audit().relative(), 1e-10);
  EXPECT_NEAR(step->fluid()->mass_drift(), 0, 1e-10);
  EXPECT_LT(step->solids()->particles().position.z[8], before - 0.04);
  EXPECT_GT(step->wet_beads(), 30U);
}

/// The thick wires are bodies, the thin one is left to the drag law; nothing is both. A broken piece goes back.
TEST(ResolvedWiresInTheStep, SwitchesByTheDiameter) {
  const auto step = coupled<double>(2.5), thin = coupled<double>(100);
  for (auto* s : {&*step, &*thin}) {
    s->fill(kWater);
    for (int n = 0; n < 20; ++n) s->advance();  // what is lent in the first steps is taken back
  }
  const Vec3 in_cable(0.205, 0.2, 0.205);
  EXPECT_GT(solid_at(*step, in_cable), 0.9);
  EXPECT_EQ(solid_at(*thin, in_cable), 0);
  EXPECT_EQ(solid_at(*step, Vec3(0.15, 0.31, 0.09)), 0);
  EXPECT_EQ(step->wet_beads(), 35U);
  EXPECT_GE(thin->wet_beads(), 35U);  // its kernels reach water where its wires do not
  const auto force = [](auto& s, std::size_t i) { return Vec3(s->solids()->particles().external_force[i]); };
  for (std::size_t i = 17; i < 47; ++i) EXPECT_GT(force(step, i).norm(), 0) << i;
  // Buoyancy of the middle piece: a cylinder by way of the cells, the bead's sphere by the law.
  const double cylinder = 9810 * std::numbers::pi * 0.04 * 0.04 * 0.08;
  EXPECT_NEAR(force(step, 2).z() / cylinder, 0.9, 0.35);
  EXPECT_NEAR(force(thin, 2).z() / (2.0 / 3 * cylinder), 0.9, 0.35);
  step->solids()->bonds().intact[1] = 0;
  step->advance();
  EXPECT_EQ(solid_at(*step, Vec3(0.2075, 0.171, 0.203)), 0);
  EXPECT_GT(solid_at(*step, Vec3(0.202, 0.24, 0.207)), 0.9);
  EXPECT_EQ(step->wet_beads(), 35U);
  EXPECT_GT(force(step, 1).z(), 0);
}

/// A ring that sinks in still water, face on: mapped and by the law it falls through the same water with like speed.
TEST(ResolvedWiresInTheStep, ARingSinksAlikeByEitherWay) {
  const auto speed = [](double resolve_from) {
    lbm::FluidOptions fluid = by_distance(stream(40, 0.02, 4e-4));
    fluid.kinematic_viscosity = 2e-4;
    Chains c;
    c.add(circle(Vec3(0.41, 0.4, 0.6), Vec3::UnitZ(), 0.4, 15), 0.08, true, dem::ParticleState::free, 5000);
    CouplingOptions options;
    options.substeps = 40;
    options.mapped_wires = MappedWires{resolve_from};
    CoupledStep<float> step(fluid, solids_of(std::move(c), Vec3(0, 0, -2)), options);
    step.fluid()->fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
    while (step.time() < 0.3) step.advance();
    double sum = 0;
    for (std::size_t i = 0; i < 15; ++i) sum -= step.solids()->particles().velocity.z[i] / 15;
    return sum;
  };
  const double mapped = speed(2), law = speed(100), free = 2 * 0.3;
  EXPECT_LT(mapped, 0.9 * free);
  EXPECT_LT(law, 0.95 * free);
  EXPECT_NEAR(mapped / law, 1, 0.3);
}

/// A free cable that is set going in still water of its own viscosity: the water in its place must be held, and no more
/// of its inertia given back than the exchange moves, or its beads spin up.
TEST(ResolvedWiresInTheStep, ACableInWaterWinsNoSpeed) {
  for (const double cells : {1.5, 3.0}) {
    lbm::FluidOptions fluid = by_distance(stream(32, 0.02, 5e-4));
    fluid.kinematic_viscosity = 1e-6;
    fluid.smagorinsky = 0.16;
    const double d = cells * fluid.domain.cell_size;
    const int beads = 1 + static_cast<int>(0.36 / d);
    Chains c;
    c.add(straight_line(Vec3(0.14, 0.33, 0.31), Vec3(0.14 + d * (beads - 1), 0.32, 0.33), beads), d, false,
          dem::ParticleState::free, 7850);
    for (std::size_t i = 0; i < c.particles.size(); ++i) c.particles.velocity.set(i, Vec3(0, 0, 0.1));
    CouplingOptions options;
    options.substeps = 200;
    options.mapped_wires = MappedWires{1.0};
    CoupledStep<double> step(fluid, solids_of(std::move(c), Vec3::Zero()), options);
    step.fluid()->fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
    for (int s = 0; s < 240; ++s) step.advance();
    const dem::Particles& p = step.solids()->particles();
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_LT(Vec3(p.velocity[i]).norm(), 0.11) << cells << ' ' << i;
  }
}

/// A ring and a wire across it, each held at two beads, of the paper's stiffness, in still water: the bonds turn round
/// many times in a step of the fluid. A force of the cells that is held over it alone shakes them, to 10 m/s.
TEST(ResolvedWiresInTheStep, AStiffNetInWaterComesToRest) {
  constexpr double cell = 0.003, stiffness = 3e11, middle = 28 * cell;
  for (const double density : {7850.0, 2000.0}) {
    lbm::FluidOptions fluid = by_distance(stream(56, cell, 6e-5));
    fluid.kinematic_viscosity = 1e-6;
    Chains net;
    net.add(circle(Vec3::Constant(middle), Vec3::UnitY(), 0.1, 48), 0.0061, true, dem::ParticleState::free, density);
    net.add(
        straight_line(Vec3(middle - 0.08, middle + 0.0062, middle), Vec3(middle + 0.08, middle + 0.0062, middle), 27),
        0.0061, false, dem::ParticleState::free, density);
    for (dem::BondSort& sort : net.bonds.sorts)
      sort.axial.stiffness = {stiffness, stiffness, stiffness}, sort.shear_stiffness = stiffness,
      sort.damping_ratio = 0.02;
    for (const dem::ParticleIndex i : {0U, 24U, 48U, 74U})
      net.particles.state[i] = dem::ParticleState::fixed, net.particles.inverse_mass[i] = 0;
    for (dem::ParticleIndex i = 0; i < net.particles.size(); ++i)
      if (net.particles.inverse_mass[i] > 0) net.particles.velocity.set(i, Vec3(0, 0.01 * std::sin(3.0 * i), 0));
    CouplingOptions options;
    options.substeps = 120;
    options.mapped_wires = MappedWires{1};
    CoupledStep<double> step(fluid, solids_of(std::move(net), Vec3::Zero()), options);
    step.fluid()->fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
    double fastest = 0;
    for (int s = 0; s < 360; ++s) {
      step.advance();
      fastest = 0;
      const dem::Particles& p = step.solids()->particles();
      for (dem::ParticleIndex i = 0; i < p.size(); ++i) fastest = std::max(fastest, Vec3(p.velocity[i]).norm());
    }
    EXPECT_LT(fastest, 1e-3) << density;
  }
}

TEST(ResolvedWiresInTheStep, SameResultWithAnyNumberOfThreads) {
  const auto end = [](int threads) {
    const ThreadLimit limit(threads);
    const auto step = coupled<float>(2.5);
    step->fill(kWater);
    for (int s = 0; s < 150; ++s) step->advance();
    return step->solids()->particles().position.z;
  };
  EXPECT_EQ(end(1), end(2));
}

template <class Real>
void expect_same_after_restart() {
  const auto whole = coupled<Real>(2.5), resumed = coupled<Real>(2.5);
  whole->fill(kWater);
  for (int n = 0; n < 120; ++n) {
    if (n == 60) whole->solids()->bonds().intact[1] = whole->solids()->bonds().intact[8] = 0;
    whole->advance();
  }
  StoredState state = state_of(*whole);
  load_state(state, *resumed);
  EXPECT_TRUE(differing_lists(state, state_of(*resumed)).empty()) << "what was loaded is not what was stored";
  for (int n = 0; n < 40; ++n) whole->advance(), resumed->advance();
  const auto differing = differing_lists(state_of(*whole), state_of(*resumed));
  EXPECT_TRUE(differing.empty()) << testing::PrintToString(differing);
  EXPECT_EQ(whole->wet_beads(), resumed->wet_beads());
}

TEST(ResolvedWiresInTheStep, GoOnAfterACheckpointInDouble) { expect_same_after_restart<double>(); }

TEST(ResolvedWiresInTheStep, GoOnAfterACheckpointInFloat) { expect_same_after_restart<float>(); }

}  // namespace
}  // namespace lahar::coupling
