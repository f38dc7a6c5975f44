// A gate that is taken away: water and grains behind it go together.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/memory_archive.h"
#include "coupling/coupled_step.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

constexpr double kOpening = 0.03;  // s

/// Fixed ones reach a centimetre into the gate.
template <class Real>
std::unique_ptr<CoupledStep<Real>> grains_behind_a_gate(dem::ParticleState state = dem::ParticleState::free) {
  Wall gate{"gate", SolidBox{Vec3(0.2, -1, -1), Vec3(0.26, 1, 1)}};
  gate.opens_at = kOpening;
  dem::Particles p;
  for (int y = 0; y < 2; ++y)
    for (int z = 0; z < 3; ++z) {
      const double x = state == dem::ParticleState::fixed ? 0.18 : 0.17;
      dem::ParticleSpec spec = grain({x, 0.045 + 0.07 * y, 0.03 + 0.06 * z}, 0.03, 2500);
      spec.state = state;
      p.add(spec);
    }
  Walls walls;
  walls.add(gate);
  walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  dem::SolidsOptions options;
  options.gravity = Vec3(4, 0, -9.0);
  options.time_step = 1;  // set by the coupled step
  lbm::FluidOptions fluid = by_distance(tank(Vec3(0.64, 0.16, 0.4), 0.02, 2e-4), lbm::BodyWeighting::inertial);
  fluid.gravity = options.gravity;
  fluid.domain.walls.add(gate);
  return std::make_unique<CoupledStep<Real>>(fluid, dem::Solids(p, {}, rock(), walls, options),
                                             CouplingOptions{.thin_wires = ThinWires::uncoupled, .substeps = 20});
}

const std::vector<lbm::LiquidRegion> kWater{{Vec3::Zero(), Vec3(0.2, 0.16, 0.22)}};

template <class Real>
double farthest_grain(CoupledStep<Real>& step) {
  const auto& x = step.solids()->particles().position.x;
  return *std::max_element(x.begin(), x.end());
}

TEST(OpenWalls, LetWaterAndGrainsGo) {
  const auto step = grains_behind_a_gate<double>();
  step->fill(kWater);
  while (step->time() < 0.9 * kOpening) step->advance();
  EXPECT_LT(farthest_grain(*step), 0.1701);
  EXPECT_LT(step->solids()->force_on_wall(0).norm(), 100);
  EXPECT_GT(step->solids()->force_on_wall(0).x(), 1) << "the grains lean on the gate";
  EXPECT_FALSE(step->fluid()->cell_at(Vec3(0.23, 0.08, 0.02)).has_value());
  while (step->time() < kOpening + 0.15) step->advance();
  EXPECT_GT(farthest_grain(*step), 0.2);
  EXPECT_EQ(step->solids()->force_on_wall(0).norm(), 0);
  EXPECT_TRUE(step->fluid()->cell_at(Vec3(0.23, 0.08, 0.015)).has_value());
  EXPECT_NEAR(step->fluid()->mass_drift(), 0, 1e-10);
  EXPECT_LT(step->audit().relative(), 1e-10);
}

/// The springs between grains and gate go with it; the ledger knows.
TEST(OpenWalls, EnergyOfSpringsIsBooked) {
  const auto step = grains_behind_a_gate<double>();
  dem::Solids& solids = *step->solids();
  for (int n = 0; n < 2000; ++n) solids.step();
  const dem::EnergyLedger before = solids.ledger();
  ASSERT_TRUE(solids.open_walls_by(kOpening));
  const dem::EnergyLedger after = solids.ledger();
  EXPECT_GT(after.removed, 0);
  EXPECT_LT(after.elastic_normal, 0.9 * before.elastic_normal);
  EXPECT_NEAR(after.total(), before.total(), 1e-6 * before.elastic_normal);
  EXPECT_EQ(after.kinetic, before.kinetic);
}

/// What the step before it opened has put on other walls stays readable until the next step.
TEST(OpenWalls, ForcesOnOtherWallsStay) {
  const auto step = grains_behind_a_gate<double>();
  dem::Solids& solids = *step->solids();
  for (int n = 0; n < 2000; ++n) solids.step();
  const Vec3 force = solids.force_on_wall(1), moment = solids.moment_on_wall(1);
  EXPECT_LT(force.z(), -1);
  ASSERT_GT(solids.force_on_wall(0).norm(), 1);
  ASSERT_TRUE(solids.open_walls_by(kOpening));
  EXPECT_EQ(solids.force_on_wall(1), force);
  EXPECT_EQ(solids.moment_on_wall(1), moment);
  EXPECT_EQ(solids.force_on_wall(0), Vec3(Vec3::Zero()));
}

TEST(OpenWalls, GoOnAfterACheckpoint) {
  const auto whole = grains_behind_a_gate<float>(), resumed = grains_behind_a_gate<float>();
  whole->fill(kWater);
  while (whole->time() < kOpening + 0.02) whole->advance();
  StoredState state = state_of(*whole);
  load_state(state, *resumed);
  for (int n = 0; n < 151; ++n) whole->advance(), resumed->advance();
  const auto differing = differing_lists(state_of(*whole), state_of(*resumed));
  EXPECT_TRUE(differing.empty()) << testing::PrintToString(differing);
}

/// A grain that does not move lies partly in the gate, and is spread anew when that is gone: also where the step in
/// which it opened was the last before the checkpoint.
TEST(OpenWalls, GoOnFromTheStepInWhichTheyOpened) {
  const auto whole = grains_behind_a_gate<float>(dem::ParticleState::fixed),
             resumed = grains_behind_a_gate<float>(dem::ParticleState::fixed);
  whole->fill(kWater);
  while (!whole->solids()->walls().all()[0].open) whole->advance();
  StoredState state = state_of(*whole);
  load_state(state, *resumed);
  for (int n = 0; n < 50; ++n) whole->advance(), resumed->advance();
  const auto differing = differing_lists(state_of(*whole), state_of(*resumed));
  EXPECT_TRUE(differing.empty()) << testing::PrintToString(differing);
}

}  // namespace
}  // namespace lahar::coupling
