// Solids whose particles are renumbered at any time go on with the same bits: states and sums are compared by id.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>

#include "core/memory_archive.h"
#include "core/parallel.h"
#include "dem/solids.h"
#include "dem/spatial_order.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

struct SceneSpec {
  double rolling_friction = 0.2;
  int long_step = 1;
  WireContacts wire_contacts = WireContacts::beads;
  double strength = 1e6;  ///< Pa, of the bonds
  double time_step = 2e-5;
};

/// Grains of two sizes rain on chains of beads, a ring and a floor that moves; bonds yield, and break under them.
Solids scene(const SceneSpec& spec) {
  Particles p = testing::loose_grains(5, 5, 4, 0.02, 0.04, 4);
  for (double& z : p.position.z) z += 0.05;
  Bonds bonds;
  BondSort wire;
  wire.axial.stiffness = {1e9, 1e8, 1e8};
  wire.axial.force_limit = {2, 1e9};
  wire.axial.plastic_unloading = true;
  wire.shear_stiffness = 1e9;
  wire.bond_radius = 0.003;
  wire.damping_ratio = 0.05;
  wire.tensile_strength = wire.shear_strength = spec.strength;
  bonds.add_sort(wire);
  const auto add_bead = [&](const Vec3& x, int body, bool fixed) {
    ParticleSpec bead = testing::sphere(x, 0.003, 7850);
    bead.kind = ParticleKind::bead, bead.body = body;
    if (fixed) bead.state = ParticleState::fixed;
    return p.add(bead);
  };
  for (int chain = 0; chain < 3; ++chain)
    for (int n = 0; n < 60; ++n) {
      const ParticleId i = add_bead({0.02 + 0.006 * n, 0.1 + 0.1 * chain, 0.03}, chain, n % 59 == 0);
      if (n > 0) bonds.add({i - 1, i, 0}, p);
    }
  const auto first = static_cast<ParticleId>(p.size());
  for (int n = 0; n < 40; ++n) {  // a ring on the chains
    const double turn = 2 * std::numbers::pi * n / 40;
    const ParticleId i = add_bead({0.2 + 0.0383 * std::cos(turn), 0.1 + 0.0383 * std::sin(turn), 0.0365}, 3, false);
    if (n > 0) bonds.add({i - 1, i, 0}, p);
  }
  bonds.add({first + 39, first, 0}, p);
  SolidsOptions o;
  o.gravity = {1, 0, -9.81};
  o.time_step = spec.time_step;
  o.long_step = spec.long_step;
  o.wire_contacts = spec.wire_contacts;
  o.watchdog.overlap_limit = 5;  // the beads are small beside the grains
  Materials m;
  m.add({"any", 1e7, 0.25});
  m.set_pair(0, 0, 0.5, 0.5, spec.rolling_friction);
  Walls walls = testing::open_box({0.41, 0.41, 1});
  walls.add({.name = "belt", .shape = HalfSpace{{0, 0, 0.005}, Vec3::UnitZ()}, .velocity = {0.3, 0, 0}});
  return {std::move(p), std::move(bonds), m, walls, o};
}

/// All that a run shows.
struct Outcome {
  StoredState state;
  std::vector<double> sums;
  std::size_t broken = 0, wires_touching = 0;
};

Outcome outcome_of(Solids& s) {
  Outcome o;
  o.state = state_of(s);
  const EnergyLedger ledger = s.ledger();
  for (const auto& [name, joules] : ledger.terms()) o.sums.push_back(joules);
  for (std::uint32_t w = 0; w < s.walls().all().size(); ++w)
    for (const Vec3& v : {s.force_on_wall(w), s.moment_on_wall(w)}) o.sums.insert(o.sums.end(), {v.x(), v.y(), v.z()});
  for (const Vec3& v : {momentum(s.particles()), angular_momentum(s.particles())})
    o.sums.insert(o.sums.end(), {v.x(), v.y(), v.z()});
  const WorstOverlap worst = s.worst_overlap();
  o.sums.insert(o.sums.end(), {worst.ratio, double(worst.particle), double(worst.partner)});
  o.broken = static_cast<std::size_t>(std::count(s.bonds().intact.begin(), s.bonds().intact.end(), 0));
  o.wires_touching = s.wires() ? s.wires()->touching() : 0;
  return o;
}

using Reorder = std::function<void(Solids&)>;
void keep_places(Solids&) {}
void shuffle(Solids& s) {
  static std::mt19937 random(1);
  std::vector<ParticleIndex> order(s.particles().size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), random);
  s.renumber(Renumbering(std::move(order)));
}
void order_in_space(Solids& s) { s.renumber(spatial_order(s.particles())); }

/// Runs with a grain that is pushed from outside, one that is taken out and one that comes late.
Outcome run(const SceneSpec& spec, int steps, int every, const Reorder& reorder) {
  Solids s = scene(spec);
  reorder(s);
  for (int n = 0; n < steps; n += every) {
    if (n == 100 * every) s.particles().external_force.set(s.particles().index(3), {0.1, 0, 0.2});
    if (n == 200 * every) s.remove(s.particles().index(7));
    if (n == 210 * every) s.particles().add(testing::sphere({0.2, 0.2, 0.6}, 0.03, 2650));
    reorder(s);
    s.advance(every);
  }
  Outcome result = outcome_of(s);
  reorder(s);
  EXPECT_EQ(result.sums, outcome_of(s).sums) << "between steps nothing may change";
  return result;
}

void expect_same(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.sums, b.sums);
  const auto differing = differing_lists(a.state, b.state);
  EXPECT_TRUE(differing.empty()) << ::testing::PrintToString(differing);
}

TEST(SolidsRenumber, GrainsAndBondsThatBreakKeepTheirBits) {
  constexpr int steps = 9000, every = 30;
  const Outcome plain = run({}, steps, every, keep_places);
  EXPECT_GT(plain.broken, 3U);
  EXPECT_GT(plain.sums[12], 0) << "something rolls";
  EXPECT_NE(plain.sums.at(17), 0) << "the belt does work";
  expect_same(plain, run({}, steps, every, shuffle));
  expect_same(plain, run({}, steps, every, order_in_space));
  const ThreadLimit limit(2);
  expect_same(plain, run({}, steps, every, shuffle));
}

TEST(SolidsRenumber, SmoothWiresKeepTheirBits) {
  const SceneSpec spec{
      .rolling_friction = 0, .wire_contacts = WireContacts::capsules, .strength = 3e6, .time_step = 1e-5};
  constexpr int steps = 12000, every = 40;
  const Outcome plain = run(spec, steps, every, keep_places);
  EXPECT_GT(plain.broken, 0U);
  EXPECT_GT(plain.wires_touching, 5U);
  expect_same(plain, run(spec, steps, every, shuffle));
  const ThreadLimit limit(2);
  expect_same(plain, run(spec, steps, every, shuffle));
}

TEST(SolidsRenumber, TwoRatesKeepTheirBits) {
  const SceneSpec spec{.long_step = 5};
  constexpr int steps = 9000, every = 30;
  const Outcome plain = run(spec, steps, every, keep_places);
  EXPECT_GT(plain.broken, 3U);
  expect_same(plain, run(spec, steps, every, shuffle));
  const ThreadLimit limit(2);
  expect_same(plain, run(spec, steps, every, shuffle));
}

TEST(SolidsRenumber, ARestartNeedsNotKnowOfIt) {
  Solids whole = scene({}), other = scene({});
  whole.advance(2000);
  whole.advance(3000);
  other.advance(2000);
  shuffle(other);
  other.advance(3000);
  StoredState state = state_of(other);
  EXPECT_TRUE(differing_lists(state, state_of(whole)).empty()) << "states are in the order of ids";
  EXPECT_FALSE(other.particles().numbering.by_id()) << "storing leaves the places as they were";
  Solids resumed = scene({});
  shuffle(resumed);
  load_state(state, resumed);
  shuffle(resumed);
  whole.advance(1000), other.advance(1000), resumed.advance(1000);
  expect_same(outcome_of(whole), outcome_of(other));
  expect_same(outcome_of(whole), outcome_of(resumed));
}

TEST(SolidsRenumber, RefusesAnOrderOfOtherParticles) {
  Solids s = scene({});
  EXPECT_THROW(s.renumber(Renumbering({1, 0})), std::logic_error);
}

}  // namespace
}  // namespace lahar::dem
