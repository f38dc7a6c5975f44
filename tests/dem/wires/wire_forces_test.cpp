// Forces of smooth wires: smooth sliding, conservation, energy; what breaks, restarts and other threads do to them.
#include "dem/wires/wire_forces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>

#include "core/memory_archive.h"
#include "core/parallel.h"
#include "core/worst.h"
#include "dem/contact/contact_forces.h"
#include "tests/dem/wire_scenes.h"

namespace lahar::dem {
namespace {

using testing::WireScene;
constexpr double r = testing::kWireRadius, L = testing::kSpacing;

struct Range {
  double least = 1e300, most = -1e300;
  void add(double x) { least = std::min(least, x), most = std::max(most, x); }
  [[nodiscard]] double ripple() const { return (most - least) / most; }
};

Vec3 bead_force_on(const WireScene& scene, ParticleIndex i) {
  Particles p = scene.particles;
  ContactDetection contacts;
  PairSet bonded;
  bonded.assign(p.size(), scene.bonds.i, scene.bonds.j, scene.bonds.intact);
  contacts.rebuild(p, {}, bonded);
  ContactForces forces(testing::steel(), HertzMindlin{});
  forces.compute(p, contacts, {}, Vec3::Zero(), 0);
  return p.force[i];
}

TEST(WireForces, SphereSlidesAlongAStraightWireWithoutRipple) {
  constexpr double a = 0.004, overlap = 2e-5;
  Range smooth, beads, along;
  for (int k = 0; k <= 60; ++k) {
    WireScene s;
    s.add_wire(testing::straight(9, Vec3::Zero(), Vec3::UnitX()));
    const ParticleIndex grain = s.add_grain({L * (k / 30.0 - 1), 0, a + r - overlap}, a);
    beads.add(bead_force_on(s, grain).z());
    testing::evaluate(s.particles, s.bonds, testing::steel());
    smooth.add(s.particles.force[grain].z());
    along.add(std::abs(s.particles.force[grain].x()));
  }
  std::printf("    ripple of the normal force: capsules %.2e, beads %.2e\n", smooth.ripple(), beads.ripple());
  EXPECT_LT(smooth.ripple(), 1e-6);
  EXPECT_LT(along.most, 1e-6 * smooth.most);
  EXPECT_GT(beads.ripple(), 0.9) << "the sphere falls between beads: what capsules are for";
  // sqrt(R' R''), 1/R' = 1/a and 1/R'' = 1/a + 1/r
  const double radius = std::sqrt(a / (1 / a + 1 / r));
  const double hertz =
      4.0 / 3 * testing::steel().pair(0, 0).effective_modulus * std::sqrt(radius) * std::pow(overlap, 1.5);
  EXPECT_NEAR(smooth.most / hertz, 1, 3e-3);
}

/// Equal wires that cross at a right angle are as a sphere of their radius on a plane.
TEST(WireForces, WiresThatCrossFollowHertz) {
  constexpr double overlap = 2e-5;
  WireScene s;
  s.add_wire(testing::straight(9, Vec3::Zero(), Vec3::UnitX()));
  s.add_wire(testing::straight(9, {0, 0, 2 * r - overlap}, Vec3::UnitY()));
  testing::evaluate(s.particles, s.bonds, testing::steel());
  double force = 0;
  for (std::size_t i = 9; i < 18; ++i) force += s.particles.force.z[i];
  const double hertz = 4.0 / 3 * testing::steel().pair(0, 0).effective_modulus * std::sqrt(r) * std::pow(overlap, 1.5);
  EXPECT_NEAR(force / hertz, 1, 3e-3);
}

/// A run of segments has caps of its own: where a wire crosses the end of another one, it is pressed as in its middle.
TEST(WireForces, AWireIsAsHardAtItsEndAsInItsMiddle) {
  const auto force = [](double from_end) {
    WireScene s;
    const ParticleIndex gives = s.add_wire(testing::straight(9, {from_end * L, 0, 2 * r - 2e-5}, Vec3::UnitY()));
    s.add_wire(testing::straight(9, {4 * L, 0, 0}, Vec3::UnitX()));
    testing::evaluate(s.particles, s.bonds, testing::steel());
    double sum = 0;
    for (ParticleIndex i = gives; i < gives + 9; ++i) sum += s.particles.force[i].z();
    return sum;
  };
  const double middle = force(4);
  EXPECT_GT(middle, 0);
  for (const double from_end : {1.0, 0.5, 0.1, 0.0}) EXPECT_NEAR(force(from_end) / middle, 1, 1e-6) << from_end;
}

/// Largest change of force and of torque about the first wire's bead 0 between steps of a movement, over the largest
/// force (times lever).
template <class Place>
double largest_jump(int steps, const Place& place) {
  Vec3 last_force, last_torque;
  double jump = 0, force = 0;
  for (int k = 0; k <= steps; ++k) {
    WireScene s;
    const ParticleIndex beads = place(s, static_cast<double>(k) / steps);
    testing::evaluate(s.particles, s.bonds, testing::steel());
    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    for (ParticleIndex i = 0; i < beads; ++i) {
      sum += s.particles.force[i];
      torque += (s.particles.position[i]).cross(s.particles.force[i]) + s.particles.torque[i];
    }
    force = std::max(force, sum.norm());
    if (k > 0) jump = std::max({jump, (sum - last_force).norm(), (torque - last_torque).norm() / (4 * L)});
    last_force = sum, last_torque = torque;
  }
  return jump / force;
}

TEST(WireForces, ForcesHaveNoStepsAtJointsOfARing) {
  // A grain travels around inside of a ring (concave) and outside (convex): halving the way halves the largest change.
  for (const double side : {-1.0, 1.0}) {
    const auto place = [&](WireScene& s, double way) {
      s.add_wire(testing::circle(36, 0.0344, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()), true);
      const double turn = 0.3 + 0.4 * way, at = 0.0344 + side * (0.004 + r - 3e-4);
      s.add_grain({at * std::cos(turn), at * std::sin(turn), 0.001}, 0.004);
      return ParticleIndex{36};
    };
    const double coarse = largest_jump(100, place), fine = largest_jump(400, place);
    EXPECT_LT(fine, 0.01);
    EXPECT_LT(fine, 0.3 * coarse) << side;
  }
}

TEST(WireForces, ForcesHaveNoStepsWhileWiresTurnThroughParallel) {
  // Segments that end opposite to each other and segments that do not; the ends of the shorter wire lie on the other
  // one.
  for (const double shift : {0.0, 0.37}) {
    const auto place = [&](WireScene& s, double way) {
      const double turn = 0.04 * (way - 0.5);
      s.add_wire(testing::straight(5, Vec3::Zero(), Vec3::UnitX()));
      s.add_wire(testing::straight(9, {shift * L, 1e-5, 2 * r - 4e-5}, {std::cos(turn), std::sin(turn), 0.1 * turn}));
      return ParticleIndex{5};
    };
    const double coarse = largest_jump(100, place), fine = largest_jump(400, place);
    EXPECT_LT(fine, 0.02);
    EXPECT_LT(fine, 0.3 * coarse) << shift;
  }
}

/// Two wires bent at random that press on each other, and a grain between them.
WireScene tangle(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto u = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  WireScene s;
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0.5, 1, 0)}) {
    auto points = testing::straight(8, {0, 0, s.bodies * (2 * r - 4e-4)}, way);
    for (Vec3& x : points) x += 0.04 * L * Vec3(u(), u(), u());
    s.add_wire(points);
  }
  s.add_grain({L, 0.006, 0.004}, 0.004);
  for (std::size_t i = 0; i < s.particles.size(); ++i) {
    s.particles.velocity.set(i, Vec3(u(), u(), u()));
    s.particles.angular_velocity.set(i, 200 * Vec3(u(), u(), u()));
  }
  return s;
}

TEST(WireForces, AreTheGradientOfTheirEnergy) {
  WireScene s = tangle(3);
  const Materials m = testing::steel();
  const WireForces forces = testing::evaluate(s.particles, s.bonds, m);
  ASSERT_GT(forces.touching(), 3U);
  constexpr double h = 1e-8;
  double largest = 0, error = 0;
  for (std::size_t i = 0; i < s.particles.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 x = s.particles.position[i], way = h * Vec3::Unit(axis);
      s.particles.position.set(i, x + way);
      const double up = forces.normal_energy(s.particles);
      s.particles.position.set(i, x - way);
      const double down = forces.normal_energy(s.particles);
      s.particles.position.set(i, x);
      largest = std::max(largest, std::abs(s.particles.force[i][axis]));
      error = std::max(error, std::abs(s.particles.force[i][axis] + (up - down) / (2 * h)));
    }
  std::printf("    largest difference of force and gradient %.2e of the largest force\n", error / largest);
  EXPECT_LT(error, 1e-4 * largest);  // of four Gauss nodes; what they leave out moves with the patch
}

TEST(WireForces, ChangeNeitherMomentumNorAngularMomentum) {
  WireScene s = tangle(5);
  s.particles.body[16] = -1;
  const WireForces forces = testing::evaluate(s.particles, s.bonds, testing::steel(0.5, 0.3), 1e-6);
  ASSERT_GT(forces.touching(), 3U);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double sum = 0, turning = 0;
  for (std::size_t i = 0; i < s.particles.size(); ++i) {
    const Vec3 f = s.particles.force[i], t = s.particles.torque[i];
    force += f, moment += s.particles.position[i].cross(f) + t;
    sum += f.norm(), turning += t.norm();
  }
  EXPECT_GT(turning, 0) << "friction acts";
  EXPECT_LT(force.norm(), 1e-13 * sum);
  EXPECT_LT(moment.norm(), 1e-13 * sum * 0.05);
}

double gap_of_ledger(Solids& solids, int steps, double& exchanged) {
  solids.advance(0);
  const EnergyLedger first = solids.ledger();
  double gap = 0;
  exchanged = 0;
  for (int n = 0; n < steps; ++n) {
    solids.step();
    const EnergyLedger now = solids.ledger();
    keep_worst(gap, std::abs(now.total() - first.total()));
    exchanged = std::max(exchanged, std::abs(first.kinetic - now.kinetic));
  }
  return gap;
}

TEST(WireForces, LedgerClosesWhenAGrainStrikesAWire) {
  for (const auto& [friction, restitution] : {std::pair{0.0, 1.0}, {0.4, 1.0}, {0.4, 0.5}}) {
    WireScene s;
    s.add_wire(testing::straight(15, Vec3::Zero(), Vec3::UnitX()));
    s.add_grain({0.0013, 0.001, 0.0063}, r, {0.3, 0.1, -2});
    Solids solids(s.particles, s.bonds, testing::steel(friction, restitution), {}, testing::smooth(2e-7));
    double exchanged = 0;
    const double gap = gap_of_ledger(solids, 2500, exchanged);
    EXPECT_GT(exchanged, 1e-4);
    EXPECT_LT(gap, 1e-3 * exchanged) << friction << " " << restitution;
    EXPECT_EQ(solids.wires()->touching(), 0U) << "they have parted";
    EXPECT_EQ(solids.ledger().friction > 0, friction > 0);
    EXPECT_EQ(solids.ledger().contact_damping > 1e-9 * exchanged, restitution < 1);
  }
}

/// Where a strong damper has just begun to act, half a step of it is large (docs/decisions/0051): the ledger counts it.
TEST(WireForces, LedgerKnowsWhatADamperIsAhead) {
  WireScene s;
  s.add_wire(testing::straight(15, Vec3::Zero(), Vec3::UnitX()));
  s.add_grain({0.0013, 0.001, 0.0063}, r, {0.3, 0.1, -2});
  const Materials steel = testing::steel(0, 0.1);
  const double step = 0.2 * rayleigh_time_step(s.particles, steel);
  Solids solids(s.particles, s.bonds, steel, {}, testing::smooth(step));
  solids.advance(0);
  const double first = solids.ledger().total();
  double gap = 0, without = 0, exchanged = 0;
  for (int n = 0; n < static_cast<int>(5e-4 / step); ++n) {
    solids.step();
    const EnergyLedger now = solids.ledger();
    keep_worst(gap, std::abs(now.total() - first));
    keep_worst(without, std::abs(now.total() - solids.wires()->energy().damped_ahead - first));
    exchanged = std::max(exchanged, now.contact_damping);
  }
  EXPECT_LT(gap, 5e-3 * exchanged);
  EXPECT_GT(without, 15e-3 * exchanged) << "what the ledger would lack";
}

/// Wherever a grain strikes a wire, on a bead or between two, it rebounds as is set: the dampers of the segments that
/// its patch covers add up to one. (Each by itself they took too much: 0.39 between beads for 0.5.)
TEST(WireForces, AGrainReboundsAlikeEverywhere) {
  constexpr double a = 0.004;
  for (const double restitution : {0.1, 0.5, 0.8})
    for (const double x : {0.0, 0.2 * L, 0.5 * L}) {
      WireScene s;
      s.add_wire(testing::straight(9, Vec3::Zero(), Vec3::UnitX()), false, ParticleState::fixed);
      const ParticleIndex grain = s.add_grain({x, 0, a + r + 1e-7}, a, {0, 0, -1});
      Solids solids(s.particles, s.bonds, testing::steel(0, restitution), {}, testing::smooth(1e-7));
      for (int step = 0; step < 4000 && (solids.particles().velocity[grain].z() < 0 || solids.wires()->touching() > 0);
           ++step)
        solids.step();
      EXPECT_NEAR(solids.particles().velocity[grain].z(), restitution, 1e-3) << restitution << " " << x;
    }
}

/// So does a wire that lands flat on another one: each of its segments bears on its own beads, and all of them together
/// on the whole wire.
TEST(WireForces, AWireThatLandsFlatReboundsAsIsSet) {
  for (const double restitution : {0.2, 0.5, 0.8})
    for (const double shift : {0.0, 0.37 * L}) {
      WireScene s;
      s.add_wire(testing::straight(15, Vec3::Zero(), Vec3::UnitX()), false, ParticleState::fixed);
      s.add_wire(testing::straight(9, {shift, 0, 2 * r + 1e-7}, Vec3::UnitX()));
      for (std::size_t i = 15; i < 24; ++i) s.particles.velocity.set(i, {0, 0, -1});
      Solids solids(s.particles, s.bonds, testing::steel(0, restitution), {}, testing::smooth(1e-7));
      const auto speed = [&] {
        double sum = 0;
        for (std::size_t i = 15; i < 24; ++i) sum += solids.particles().velocity.z[i] / 9;
        return sum;
      };
      for (int step = 0; step < 6000 && (speed() < 0 || solids.wires()->touching() > 0); ++step) solids.step();
      EXPECT_NEAR(speed(), restitution, 0.03) << restitution << " " << shift;
    }
}

/// Tangential springs add up to one, too.
TEST(WireForces, AGrainSticksAlikeEverywhere) {
  constexpr double a = 0.004;
  const auto stored = [](double x) {
    WireScene s;
    s.add_wire(testing::straight(9, Vec3::Zero(), Vec3::UnitX()), false, ParticleState::fixed);
    s.add_grain({x, 0, a + r - 2e-5}, a, {0.1, 0, 0});
    Solids solids(s.particles, s.bonds, testing::steel(5, 1), {}, testing::smooth(1e-8));
    for (int step = 0; step < 20; ++step) solids.step();
    return solids.ledger().elastic_tangential;
  };
  const double on_a_bead = stored(0);
  EXPECT_GT(on_a_bead, 0);
  EXPECT_NEAR(stored(0.5 * L) / on_a_bead, 1, 0.02);
  EXPECT_NEAR(stored(0.3 * L) / on_a_bead, 1, 0.02);
}

TEST(WireForces, LedgerClosesWhenWiresStrikeAndRub) {
  for (const auto& [friction, restitution] : {std::pair{0.0, 1.0}, {0.4, 0.5}}) {
    WireScene s;
    s.add_wire(testing::straight(15, Vec3::Zero(), Vec3::UnitX()));
    s.add_wire(testing::straight(15, {0.001, 0.002, 0.0064}, {0.3, 1, 0.02}));
    for (std::size_t i = 15; i < 30; ++i) s.particles.velocity.set(i, {0.5, 0.2, -2});
    Solids solids(s.particles, s.bonds, testing::steel(friction, restitution), {}, testing::smooth(2e-7));
    const Vec3 before = angular_momentum(solids.particles()), momentum_before = momentum(solids.particles());
    double exchanged = 0;
    const double gap = gap_of_ledger(solids, 3000, exchanged);
    EXPECT_GT(exchanged, 1e-4);
    EXPECT_LT(gap, 1e-3 * exchanged) << friction;
    EXPECT_LT((momentum(solids.particles()) - momentum_before).norm(), 1e-11 * momentum_before.norm());
    EXPECT_LT((angular_momentum(solids.particles()) - before).norm(), 1e-9 * before.norm());
  }
}

TEST(WireForces, ABondThatBreaksUnderAGrainTakesTheWireApart) {
  WireScene s;
  s.bonds.sorts[0].tensile_strength = 1e7;
  s.bonds.sorts[0].shear_strength = 1e7;
  s.add_wire(testing::straight(9, Vec3::Zero(), Vec3::UnitX()));
  s.particles.state[0] = s.particles.state[8] = ParticleState::fixed;
  s.particles.inverse_mass[0] = s.particles.inverse_mass[8] = 0;
  s.add_grain({0.001, 0, 0.01302}, 0.01, {0, 0, -2});
  Solids solids(s.particles, s.bonds, testing::steel(0.3, 0.9), {}, testing::smooth(2e-7));
  double exchanged = 0;
  const double gap = gap_of_ledger(solids, 4000, exchanged);
  const auto& intact = solids.bonds().intact;
  ASSERT_GT(std::count(intact.begin(), intact.end(), 0), 0);
  EXPECT_LT(gap, 1e-3 * exchanged);
}

/// The two ends at a broken bond hold each other off, end to end and side by side, as those of two wires do.
TEST(WireForces, StumpsOfABrokenWireTouch) {
  for (const Vec3& shift : {Vec3(-0.0005, 0, 0), Vec3(-0.012, 0, 0.0058)}) {
    std::array<double, 2> pushed{};
    for (const bool broken : {false, true}) {
      WireScene s;
      const auto line = testing::straight(10, Vec3::Zero(), Vec3::UnitX());
      if (broken) {
        s.add_wire(line);
        s.bonds.intact[4] = 0;
      } else {
        s.add_wire({line.begin(), line.begin() + 5});
        s.add_wire({line.begin() + 5, line.end()});
      }
      for (std::size_t k = 5; k < 10; ++k) s.particles.position.add(k, shift);
      testing::evaluate(s.particles, s.bonds, testing::steel());
      for (std::size_t k = 5; k < 10; ++k) pushed[broken] += s.particles.force[k].norm();
    }
    EXPECT_GT(pushed[0], 1);
    EXPECT_NEAR(pushed[1] / pushed[0], 1, 1e-9);
  }
}

TEST(WireForces, WallsStillHoldBeads) {
  WireScene s;
  s.add_wire(testing::straight(6, {0, 0, r + 1e-4}, Vec3::UnitX()));
  SolidsOptions o = testing::smooth(2e-6);
  o.gravity = {0, 0, -9.81};
  Solids solids(s.particles, s.bonds, testing::steel(0, 0.3), testing::ground(), o);
  solids.advance(20000);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(solids.particles().position.z[i], r, 1e-6);
}

/// A ring that slides and rolls down over crossed wires while grains rain on them.
Solids heap() {
  WireScene s;
  for (int k = 0; k < 4; ++k)
    s.add_wire(testing::straight(20, {0, 0.02 * (k - 1.5), 0}, Vec3::UnitX()), false, ParticleState::fixed);
  for (int k = 0; k < 3; ++k)
    s.add_wire(testing::circle(36, 0.0344, {0.01 * k, 0, 0.0061 * (k + 1)}, Vec3::UnitX(), Vec3::UnitY()), true);
  for (int k = 0; k < 12; ++k) s.add_grain({0.012 * (k % 4) - 0.02, 0.012 * (k / 4) - 0.01, 0.03}, 0.005);
  SolidsOptions o = testing::smooth(1e-6);
  o.gravity = {1, 0, -9.81};
  return {s.particles, s.bonds, testing::steel(0.3, 0.3), {}, o};
}

TEST(WireForces, SameBitsOnAnyNumberOfThreads) {
  std::array<StoredState, 2> states;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    Solids solids = heap();
    solids.advance(8000);
    EXPECT_GT(solids.wires()->touching(), 3U);
    states[threads == 1 ? 0 : 1] = state_of(solids);
  }
  EXPECT_TRUE(differing_lists(states[0], states[1]).empty());
}

TEST(WireForces, GoOnWithTheSameBitsAfterARestart) {
  Solids whole = heap();
  whole.advance(8000);
  StoredState state = state_of(whole);
  Solids resumed = heap();
  load_state(state, resumed);
  EXPECT_TRUE(differing_lists(state, state_of(resumed)).empty());
  whole.advance(3000);
  resumed.advance(3000);
  EXPECT_TRUE(differing_lists(state_of(whole), state_of(resumed)).empty());
  EXPECT_EQ(whole.ledger().total(), resumed.ledger().total());
}

}  // namespace
}  // namespace lahar::dem
