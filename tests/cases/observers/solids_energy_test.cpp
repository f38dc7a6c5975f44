// Where the energy of grains and barrier went, and that the books close.
#include "cases/observers/solids_energy.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cases/observers/small_net.h"

namespace lahar::cases {
namespace {

bool passes(const std::vector<ResultCheck>& checks) {
  const auto found =
      std::find_if(checks.begin(), checks.end(), [](const auto& c) { return c.name == "solids_energy_ledger"; });
  EXPECT_NE(found, checks.end());
  return found != checks.end() && found->pass;
}

/// A net that swings under its weight: all that it falls is stored, or lost in bonds, contacts and friction.
TEST_F(SmallNet, EnergyOfASwingingNetIsBooked) {
  const dem::Solids& solids = run_.solids();
  const double before = solids.ledger().stored();
  run_.take_row();
  run_.take_row(2000);
  const Metrics metrics = run_.metrics();
  const dem::EnergyLedger now = solids.ledger();
  const double lost = now.friction + now.contact_damping + now.bonds.dissipated();
  EXPECT_GT(lost, 0);
  EXPECT_NEAR(1000 * metrics.at("solids_friction_kJ"), now.friction, 1e-12);
  EXPECT_NEAR(1000 * metrics.at("solids_damping_kJ"), now.contact_damping, 1e-12);
  EXPECT_EQ(metrics.at("solids_work_kJ"), 0);
  EXPECT_NEAR(metrics.at("solids_energy_gap_max_J"), std::abs(now.stored() + lost - before), 1e-9);
  EXPECT_LT(metrics.at("solids_energy_gap_max_J"), 0.02 * lost);
  EXPECT_NEAR(metrics.at("solids_energy_turned_over_max_J"), now.kinetic + now.rotational + lost, 1e-9);
  EXPECT_TRUE(passes(run_.observers.checks()));
}

/// What bonds hold as the run begins is in the books of the first row.
TEST(SettledNet, RestsWithItsBooksClosed) {
  Sampled run{scene::load(scene::case_file("hanging_net/scene.toml"),
                          {"barrier.net.width_m=0.38", "barrier.net.height_m=0.26", "barrier.settle_time_s=0.3"})};
  run.take_row();
  const double held = run.solids().bond_energy().elastic();
  EXPECT_GT(held, 0);
  run.take_row(2000);
  EXPECT_LT(run.metrics().at("solids_energy_gap_max_J"), 0.02 * held);
  EXPECT_GT(run.column("upper_cable_end_force_N")[0], 0);
}

/// The books do not know where heights are counted from, so neither does what they are held against.
TEST_F(SmallNet, WhatIsTakenOutDoesNotCountAsTurnedOver) {
  run_.take_row();
  run_.take_row(1000);
  const double before = run_.metrics().at("solids_energy_turned_over_max_J");
  dem::Particles& p = run_.solids().particles();
  const dem::ParticleIndex boulder = p.add({.position = Vec3(0, 0, 1000), .radius = 0.1, .density = 2500});
  run_.take_row();
  run_.solids().remove(boulder);
  run_.take_row();
  EXPECT_NEAR(run_.metrics().at("solids_energy_turned_over_max_J"), before, 1e-6 * before);
}

/// Twice their speed comes from nowhere, as from steps that are too long.
TEST_F(SmallNet, EnergyFromNowhereFailsTheCheck) {
  run_.take_row();
  run_.take_row(1000);
  EXPECT_TRUE(passes(run_.observers.checks()));
  dem::Particles& p = run_.solids().particles();
  for (std::size_t i = 0; i < p.size(); ++i) p.velocity.set(i, 2 * p.velocity[i]);
  run_.take_row();
  EXPECT_FALSE(passes(run_.observers.checks()));
}

/// Work of outside forces is no gap; what the run before the first row lost does not count.
TEST_F(SmallNet, WorkFromOutsideIsBooked) {
  dem::Solids& solids = run_.solids();
  for (int k = 0; k < 100; ++k) run_.step();
  EXPECT_GT(solids.ledger().dissipated(), 0);
  run_.take_row();
  EXPECT_EQ(run_.metrics().at("solids_friction_kJ"), 0);
  dem::Particles& p = solids.particles();
  const double push = 0.1;  // N, on each free bead
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.inverse_mass[i] > 0) p.external_force.set(i, Vec3(push, 0, 0));
  run_.take_row(500);
  const Metrics metrics = run_.metrics();
  EXPECT_GT(metrics.at("solids_work_kJ"), 0);
  EXPECT_LT(metrics.at("solids_energy_gap_max_J"), 0.02 * 1000 * metrics.at("solids_work_kJ"));
}

/// What bonds lose in dampers and by breaking, since the first row.
TEST_F(SmallNet, LossesOfBondsAreBooked) {
  dem::Bonds& bonds = run_.solids().bonds();
  for (int k = 0; k < 100; ++k) run_.step();
  ASSERT_GT(bonds.damping_loss, 0);
  run_.take_row();
  bonds.damping_loss += 0.25, bonds.breakage_loss += 0.5;
  run_.take_row();
  const double before = bonds.damping_loss;
  run_.take_row(100);
  EXPECT_GT(bonds.damping_loss, before);
  const std::vector<double>& lost = run_.column("bonds_lost_J");
  EXPECT_EQ(lost[0], 0);
  EXPECT_NEAR(lost[1], 0.75, 1e-12);
  EXPECT_NEAR(lost[2], 0.75 + bonds.damping_loss - before, 1e-12);
}

}  // namespace
}  // namespace lahar::cases
