// Two rates: grains act on each other and on walls in long steps, beads in short ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "core/memory_archive.h"
#include "core/parallel.h"
#include "core/worst.h"
#include "dem/solids.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

struct SceneSpec {
  bool free = false;  ///< no walls, no gravity, loose chains
  double friction = 0.5, restitution = 0.5;
  double time_step = 5e-6;  ///< s, a third of what the bonds allow
  int long_step = 1;
};

/// A layer of chains of beads, held at their ends, under 4 x 4 x 4 grains that fall on them, through them and into each
/// other.
Solids scene(const SceneSpec& spec) {
  constexpr int n = 4;
  Particles p;
  Bonds bonds;
  BondSort wire;
  wire.axial.stiffness = {1e11, 1e11, 1e11};
  wire.shear_stiffness = 1e11;
  wire.bond_radius = 0.003;
  wire.damping_ratio = spec.restitution < 1 ? 0.02 : 0;
  bonds.add_sort(wire);
  for (int chain = 0; chain < 2 * n; ++chain)
    for (int m = 0; m < 51; ++m) {
      ParticleSpec bead = testing::sphere({0.01 + 0.0062 * m, 0.02 + 0.04 * chain, 0.05}, 0.003, 7850);
      bead.kind = ParticleKind::bead;
      bead.body = chain;
      if (!spec.free && m % 50 == 0) bead.state = ParticleState::fixed;
      const ParticleIndex i = p.add(bead);
      if (m > 0) bonds.add({i - 1, i, 0}, p);
    }
  std::mt19937 random(7);
  const auto u = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vec3 at(0.045 + 0.079 * i + 1e-3 * u(), 0.045 + 0.079 * j + 1e-3 * u(), 0.1 + 0.079 * k);
        ParticleSpec grain = testing::sphere(at, u() < -0.5 ? 0.038 : 0.03, 2650, {u(), u(), u() - 2});
        grain.angular_velocity = 5 * Vec3(u(), u(), u());
        p.add(grain);
      }
  SolidsOptions o = testing::options(spec.time_step, spec.free ? Vec3(0, 0, 0) : Vec3(0.5, 0, -9.81));
  o.watchdog.overlap_limit = 5;
  o.neighbours.minimum_skin = 0.003;
  o.long_step = spec.long_step;
  const double side = 0.08 * n + 0.01;
  return {std::move(p), std::move(bonds), testing::one_material(5e8, 0.25, spec.friction, spec.restitution),
          spec.free ? Walls{} : testing::open_box({side, side, 2}), o};
}

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  // kg m/s; kg m^2/s about the origin
};

Momenta momenta(const Particles& p) {
  Momenta sum;
  for (std::size_t i = 0; i < p.size(); ++i) {
    sum.linear += p.mass[i] * p.velocity[i];
    sum.angular += p.mass[i] * p.position[i].cross(p.velocity[i]) + p.inertia[i] * p.angular_velocity[i];
  }
  return sum;
}

/// Mean place of the grains, m.
Vec3 mean_place(const Particles& p) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.kind[i] == ParticleKind::grain) sum += p.position[i], ++count;
  return sum / count;
}

/// Largest departure of the ledger over `seconds`, as a share of the exchanged energy (widest range of a term).
double departure(Solids& solids, double seconds) {
  const double start = solids.ledger().total();
  std::array<double, std::tuple_size_v<decltype(EnergyLedger{}.terms())>> least{}, most{};
  least.fill(std::numeric_limits<double>::infinity());
  most.fill(-std::numeric_limits<double>::infinity());
  double worst = 0;
  for (const double end = solids.time() + seconds; solids.time() < end;) {
    solids.advance(60);
    const EnergyLedger ledger = solids.ledger();
    keep_worst(worst, std::abs(ledger.total() - start));
    const auto terms = ledger.terms();
    for (std::size_t t = 0; t < terms.size(); ++t) {
      least[t] = std::min(least[t], terms[t].second);
      most[t] = std::max(most[t], terms[t].second);
    }
  }
  double exchanged = 0;
  for (std::size_t t = 0; t < least.size(); ++t) exchanged = std::max(exchanged, most[t] - least[t]);
  return worst / exchanged;
}

TEST(SolidsRates, KeepMomentumExactly) {
  Solids solids = scene({.free = true, .long_step = 6});
  solids.advance(1);
  const Momenta before = momenta(solids.particles());
  solids.advance(6000);
  const Momenta after = momenta(solids.particles());
  EXPECT_GT(solids.ledger().friction, 1.0);  // J: grains and beads did meet
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-10 * before.angular.norm());
}

TEST(SolidsRates, EnergyOfElasticContactsDoesNotDrift) {
  Solids solids = scene({.free = true, .friction = 0, .restitution = 1, .long_step = 6});
  solids.advance(1);
  EXPECT_LT(departure(solids, 0.03), 1e-3);
}

TEST(SolidsRates, TheLedgerClosesWithFrictionAndDamping) {
  // The long step is 0.1 of what damping leaves of the Rayleigh time of the grains; scenes take 0.2 by default.
  Solids solids = scene({.long_step = 6});
  solids.advance(1);
  EXPECT_LT(departure(solids, 0.05), 1e-3);  // the bar of all ledgers
  EXPECT_GT(solids.ledger().friction, 10.0);
  EXPECT_GT(solids.contacts().stored_contacts(solids.particles()).size(), 10U);       // with beads
  EXPECT_GT(solids.slow_contacts().stored_contacts(solids.particles()).size(), 10U);  // among grains
}

TEST(SolidsRates, ComeNearToOneRateAsTheLongStepShrinks) {
  // Before chance collisions have driven the runs apart.
  const auto place = [](int long_step) {
    Solids solids = scene({.long_step = long_step});
    solids.advance(2400);
    return mean_place(solids.particles());
  };
  const Vec3 one = place(1);
  const double two = (place(2) - one).norm(), eight = (place(8) - one).norm();
  EXPECT_LT(two, 0.5 * eight);
  EXPECT_LT(eight, 1e-4);  // m, of 0.03 m that they moved
}

TEST(SolidsRates, ExternalForcesGiveForceTimesTime) {
  // One grain far from everything; 7 sub-steps do not fill two long steps of 4.
  Solids solids = scene({.free = true, .long_step = 4});
  ParticleSpec far = testing::sphere({9, 9, 9}, 0.05, 1000);
  const ParticleIndex i = solids.particles().add(far);
  const Vec3 force(1, 2, 3);
  solids.particles().external_force.set(i, force);
  solids.advance(7);
  const Vec3 momentum = solids.particles().mass[i] * solids.particles().velocity[i];
  const double dt = solids.options().time_step;
  EXPECT_LT((momentum - 7 * dt * force).norm(), 1e-12 * momentum.norm());
  solids.particles().external_force.set(i, -force);
  solids.advance(7);
  EXPECT_LT((solids.particles().mass[i] * solids.particles().velocity[i]).norm(), 1e-12 * momentum.norm());
}

TEST(SolidsRates, AWallFeelsGrainsAndBeads) {
  // At rest on the floor: one grain, and one bead of a wire that is a single bond.
  Particles p;
  p.add(testing::sphere({0, 0, 0.0999}, 0.1, 2650));
  for (const double x : {1.0, 1.02}) {
    ParticleSpec bead = testing::sphere({x, 0, 0.0099}, 0.01, 7850);
    bead.kind = ParticleKind::bead;
    p.add(bead);
  }
  Bonds bonds;
  BondSort wire;
  wire.axial.stiffness = {1e9, 1e9, 1e9};
  wire.shear_stiffness = 1e9;
  wire.bond_radius = 0.01;
  bonds.add_sort(wire);
  bonds.add({1, 2, 0}, p);
  SolidsOptions o = testing::options(2e-5, Vec3(0, 0, -9.81));
  o.long_step = 3;
  Solids solids(std::move(p), std::move(bonds), testing::one_material(1e7, 0.25, 0.5, 0.3), testing::ground(), o);
  solids.advance(30000);
  double weight = 0;
  for (const double m : solids.particles().mass) weight += 9.81 * m;
  EXPECT_NEAR(solids.force_on_wall(0).z(), -weight, 1e-6 * weight);
  // The moment about the origin is that of the beads.
  EXPECT_NEAR(solids.moment_on_wall(0).y(), 9.81 * 2 * 1.01 * solids.particles().mass[1], 1e-4 * weight);
}

TEST(SolidsRates, SameBitsOnOneAndTwoThreadsAndAfterARestart) {
  const SceneSpec spec{.long_step = 7};
  Solids one = scene(spec), resumed = scene(spec), two = scene(spec);
  {
    const ThreadLimit limit(1);
    one.advance(2000);
    StoredState state = state_of(one);
    load_state(state, resumed);
    EXPECT_TRUE(differing_lists(state, state_of(resumed)).empty()) << "what was loaded is not what was stored";
    one.advance(1500);
    resumed.advance(1500);
  }
  {
    const ThreadLimit limit(2);
    two.advance(2000);
    two.advance(1500);
  }
  EXPECT_TRUE(differing_lists(state_of(one), state_of(resumed)).empty());
  EXPECT_TRUE(differing_lists(state_of(one), state_of(two)).empty());
}

TEST(SolidsRates, ARemovedGrainTakesItsSpringsAlong) {
  Solids solids = scene({.long_step = 6});
  solids.advance(6000);
  const std::vector<StoredContact> contacts = solids.slow_contacts().stored_contacts(solids.particles());
  ASSERT_FALSE(contacts.empty());
  const double before = solids.ledger().total();
  const double held = solids.ledger().elastic_normal;
  solids.remove(contacts[0].particle);
  EXPECT_LT(solids.ledger().elastic_normal, held);
  EXPECT_NEAR(solids.ledger().total(), before, 1e-12 * std::abs(before));
}

TEST(SolidsRates, OneRateWhereNothingIsFaster) {
  // A long step changes nothing where there are only grains.
  const auto run = [](int long_step) {
    SolidsOptions o = testing::options(2e-5, Vec3(0, 0, -9.81));
    o.long_step = long_step;
    Solids solids(testing::loose_grains(3, 3, 3, 0.02, 0.04, 4), {}, testing::one_material(1e7, 0.25, 0.5, 0.5),
                  testing::open_box({0.25, 0.25, 1}), o);
    solids.advance(3000);
    return solids.ledger().total();
  };
  EXPECT_EQ(run(1), run(5));
  EXPECT_THROW(run(0), std::logic_error);
}

}  // namespace
}  // namespace lahar::dem
