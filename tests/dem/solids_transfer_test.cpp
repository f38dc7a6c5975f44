// Solids that were stored and loaded go on with the same bits: contacts, bonds and broken bonds included.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/memory_archive.h"
#include "dem/solids.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

constexpr double kOpening = 1;  // s

/// Grains that rain on chains of beads `spacing` (m) apart, whose bonds break under them; the chains stretch
/// plastically. Far from all of them is a wall that opens at kOpening.
Solids scene(double rolling_friction = 0, WireContacts wires = WireContacts::beads, double spacing = 0.006) {
  Particles p = testing::loose_grains(5, 5, 6, 0.02, 0.04, 4);
  for (double& z : p.position.z) z += 0.05;
  Bonds bonds;
  BondSort wire;
  wire.axial.stiffness = {1e9, 1e8, 1e8};
  wire.axial.force_limit = {2, 1e9};
  wire.axial.plastic_unloading = true;
  wire.shear_stiffness = 1e9;
  wire.bond_radius = 0.003;
  wire.damping_ratio = 0.05;
  wire.tensile_strength = 1e6;
  wire.shear_strength = 1e6;
  bonds.add_sort(wire);
  for (int chain = 0; chain < 3; ++chain)
    for (int n = 0; n < 60; ++n) {
      ParticleSpec bead = testing::sphere({0.02 + spacing * n, 0.1 + 0.1 * chain, 0.03}, 0.003, 7850);
      bead.kind = ParticleKind::bead;
      bead.body = chain;
      bead.state = n % 59 == 0 ? ParticleState::fixed : ParticleState::free;
      const ParticleIndex i = p.add(bead);
      if (n > 0) bonds.add({i - 1, i, 0}, p);
    }
  SolidsOptions o;
  o.gravity = {1, 0, -9.81};
  o.time_step = 2e-5;
  o.watchdog.overlap_limit = 2;  // the beads are small beside the grains
  o.wire_contacts = wires;
  Materials m;
  m.add({"any", 1e7, 0.25});
  m.set_pair(0, 0, 0.5, 0.5, rolling_friction);
  Walls walls = testing::open_box({0.41, 0.41, 1});
  Wall gate{"gate", SolidSphere{{0.2, 0.2, 5}, 0.1}};
  gate.opens_at = kOpening;
  walls.add(gate);
  return {std::move(p), std::move(bonds), m, walls, o};
}

std::size_t broken(const Solids& s) {
  return static_cast<std::size_t>(std::count(s.bonds().intact.begin(), s.bonds().intact.end(), 0));
}

void expect_same_after_restart(Solids& whole, int steps, double rolling_friction = 0,
                               WireContacts wires = WireContacts::beads) {
  StoredState state = state_of(whole);
  Solids resumed = scene(rolling_friction, wires);
  load_state(state, resumed);
  EXPECT_TRUE(differing_lists(state, state_of(resumed)).empty()) << "what was loaded is not what was stored";
  whole.advance(steps);
  resumed.advance(steps);
  const auto differing = differing_lists(state_of(whole), state_of(resumed));
  EXPECT_TRUE(differing.empty()) << ::testing::PrintToString(differing);
  EXPECT_EQ(whole.ledger().total(), resumed.ledger().total());
  EXPECT_EQ(whole.ledger().bonds.dissipated(), resumed.ledger().bonds.dissipated());
}

void expect_same_after_the_first_broken_bond(WireContacts wires) {
  Solids solids = scene(0, wires);
  for (int n = 0; n < 20000 && broken(solids) == 0; ++n) solids.step();
  ASSERT_GT(broken(solids), 0U);
  expect_same_after_restart(solids, 2000, 0, wires);
}

TEST(SolidsTransfer, GoesOnRightAfterABondHasBroken) {
  // The contact lists still leave the pair out, as they were built before.
  expect_same_after_the_first_broken_bond(WireContacts::beads);
}

TEST(SolidsTransfer, GoesOnRightAfterABondOfASmoothWireHasBroken) {
  // The wire is still one, as it was when its contacts were listed.
  expect_same_after_the_first_broken_bond(WireContacts::capsules);
}

TEST(SolidsTransfer, GoesOnWithRollingResistance) {
  Solids solids = scene(0.2);
  solids.advance(9000);
  EXPECT_GT(solids.ledger().elastic_rolling, 0);
  EXPECT_GT(solids.ledger().rolling, 0);
  expect_same_after_restart(solids, 300, 0.2);
}

TEST(SolidsTransfer, GoesOnWithContactsBondsAndBrokenBonds) {
  Solids solids = scene();
  solids.advance(9000);
  solids.remove(7);
  solids.particles().external_force.set(3, {0.1, 0, 0.2});
  solids.advance(10);
  EXPECT_GT(broken(solids), 3U);
  EXPECT_LT(broken(solids), solids.bonds().size());
  EXPECT_GT(solids.contacts().stored_contacts(solids.particles()).size(), 50U);
  EXPECT_GT(solids.ledger().friction, 0);
  EXPECT_GT(*std::max_element(solids.bonds().plastic_elongation.begin(), solids.bonds().plastic_elongation.end()), 0);
  expect_same_after_restart(solids, 2000);
}

TEST(SolidsTransfer, GoesOnFromTheVeryStart) {
  Solids solids = scene();
  expect_same_after_restart(solids, 500);
}

/// The lists are built anew where a wall opens. Beads that overlap in a bond must not touch then.
TEST(SolidsTransfer, AWallOpensAfterARestart) {
  constexpr double kClose = 0.0058;  // m, less than two radii
  Solids whole = scene(0, WireContacts::beads, kClose);
  whole.advance(200);
  ASSERT_EQ(broken(whole), 0U);
  StoredState state = state_of(whole);
  Solids resumed = scene(0, WireContacts::beads, kClose);
  load_state(state, resumed);
  for (Solids* solids : {&whole, &resumed}) {
    ASSERT_TRUE(solids->open_walls_by(kOpening));
    solids->advance(100);
  }
  const auto differing = differing_lists(state_of(whole), state_of(resumed));
  EXPECT_TRUE(differing.empty()) << ::testing::PrintToString(differing);
}

TEST(SolidsTransfer, RefusesBondsOfOtherParticles) {
  Solids solids = scene();
  solids.advance(1);
  Solids other = scene();
  StoredState state = state_of(solids);
  for (std::uint8_t& byte : state.lists.at("bonds/i").bytes) byte = 0x7f;
  EXPECT_THROW(load_state(state, other), ArchiveError);
}

TEST(SolidsTransfer, DoesNotStoreWhatIsNotANumber) {
  Solids solids = scene();
  solids.particles().velocity.x[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)state_of(solids), NumericalFailure);
}

}  // namespace
}  // namespace lahar::dem
