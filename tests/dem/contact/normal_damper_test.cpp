#include "dem/contact/normal_damper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/sphere.h"
#include "core/worst.h"
#include "dem/packing/packing.h"
#include "dem/solids.h"
#include "dem/time_step.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

constexpr double kRadius = 0.003, kDensity = 7800;

/// Steel that hardly bounces.
Materials dead_steel(double restitution) { return testing::one_material(10e9, 0.3, 0.1, restitution); }

double default_step(const Materials& m) { return 0.2 * rayleigh_time_step(kRadius, kDensity, m[0]); }

/// The twelve neighbours of a sphere in the densest packing, as unit vectors.
std::vector<Vec3> twelve_neighbours() {
  std::vector<Vec3> out;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) out.insert(out.end(), {Vec3(a, b, 0), Vec3(a, 0, b), Vec3(0, a, b)});
  for (Vec3& n : out) n.normalize();
  return out;
}

double moving(const Solids& s) { return s.ledger().kinetic + s.ledger().rotational; }

/// One bead that shakes in a cage of held ones.
Particles caged_bead(double overlap) {
  Particles p;
  p.add(testing::sphere(Vec3::Zero(), kRadius, kDensity, Vec3(0.3, -0.2, 0.1)));
  for (const Vec3& n : twelve_neighbours()) {
    ParticleSpec held = testing::sphere((2 - overlap) * kRadius * n, kRadius, kDensity, Vec3::Zero());
    held.state = ParticleState::fixed;
    p.add(held);
  }
  return p;
}

/// Twelve dampers act on one bead that shakes in a cage of held ones. Each of them solving for itself with what the
/// others did a step before, they would push it back by more than its speed, and further in every step.
TEST(NormalDamper, ABeadAmongTwelveComesToRest) {
  const Materials m = dead_steel(0.01);
  for (const double overlap : {0.01, 0.05, 0.15}) {
    Solids s{caged_bead(overlap), {}, m, {}, testing::options(default_step(m), Vec3::Zero())};
    const double start = moving(s);
    double before = start;
    for (int n = 0; n < 20; ++n) {
      for (int k = 0; k < 20; ++k) {
        s.advance(1);
        EXPECT_LT(moving(s), 1.01 * start) << overlap << ' ' << n << ' ' << k;
      }
      EXPECT_LT(moving(s), std::max(1.01 * before, 1e-9 * start)) << overlap << ' ' << n;
      before = moving(s);
    }
    EXPECT_LT(before, 1e-6 * start) << overlap;
  }
}

/// Forces are found anew whenever particles join: what the dampers do then was done before.
TEST(NormalDamper, ParticlesThatJoinAddNoEnergyToOthers) {
  const Materials m = dead_steel(0.01);
  for (const double overlap : {0.01, 0.05, 0.15}) {
    Solids s{caged_bead(overlap), {}, m, {}, testing::options(default_step(m), Vec3::Zero())};
    const double start = moving(s);
    for (int n = 0; n < 100; ++n) {
      s.particles().add(testing::sphere(Vec3(1 + n, 0, 0), kRadius, kDensity, Vec3::Zero()));
      s.advance(1);
      EXPECT_LT(moving(s), 1.01 * start) << overlap << ' ' << n;
    }
  }
}

/// A heap of loose beads under a heavy ball that falls on it: the ledger closes at the step of elastic contacts.
TEST(NormalDamper, ABallFallsIntoAHeapOfBeads) {
  for (const double restitution : {0.1, 0.01}) {
    const Materials m = dead_steel(restitution);
    Particles p;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 7; ++j)
        for (int i = 0; i < 7; ++i) {
          const double shift = 0.5 * (k % 2);
          p.add(testing::sphere(kRadius * Vec3(2 * (i + shift), 2 * (j + shift), 1 + 1.42 * k), kRadius, kDensity,
                                Vec3::Zero()));
        }
    const double ball = 5 * kRadius;
    p.add(testing::sphere(Vec3(6.5 * kRadius, 6.5 * kRadius, kRadius * 4.9 + ball), ball, kDensity, Vec3(0, 0, -5)));
    Solids s{p, {}, m, testing::ground(Vec3(0, 0, 1)), testing::options(default_step(m), Vec3(0, 0, -9.81))};
    s.advance(1);
    const double total = s.ledger().total(), exchanged = s.ledger().kinetic;
    double worst = 0;
    for (int n = 0; n < 100; ++n) {
      s.advance(50);
      keep_worst(worst, std::abs(s.ledger().total() - total) / exchanged);
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(worst, 5e-3) << restitution;
    EXPECT_GT(s.ledger().contact_damping, 0.1 * exchanged);
    EXPECT_LT(s.ledger().kinetic, 0.5 * exchanged);
  }
}

/// Restitution of a sphere on the ground whose touch falls into a step at the share `phase` of it.
double restitution_at(double phase, double restitution, const ContactLawChoice& law) {
  const Materials m = dead_steel(restitution);
  const double speed = 1, step = default_step(m);
  Particles p;
  p.add(testing::sphere(Vec3(0, 0, kRadius + phase * speed * step), kRadius, kDensity, Vec3(0, 0, -speed)));
  SolidsOptions options = testing::options(step, Vec3::Zero());
  options.contact_law = law;
  Solids s{p, {}, m, testing::ground(), options};
  s.advance(5);
  while (s.particles().position.z[0] < kRadius) s.advance(1);
  return s.particles().velocity.z[0] / speed;
}

/// What a contact returns hardly depends on when in a step it began.
TEST(NormalDamper, TheMomentOfTheTouchHardlyMatters) {
  for (const ContactLawChoice& law :
       {ContactLawChoice{HertzMindlin{}}, ContactLawChoice{LinearSpringDashpot{4e5, 1e5}}})
    for (const double wanted : {0.1, 0.2, 0.5, 0.8})
      for (const double phase : {0.05, 0.3, 0.6, 0.95})
        EXPECT_NEAR(restitution_at(phase, wanted, law) / wanted, 1, 0.012)
            << wanted << ' ' << phase << ' ' << law.index();
}

TEST(NormalDamper, FirstValuesCountForTheTimeInContact) {
  EXPECT_DOUBLE_EQ(weight_of_constant_damper(0.25), 0.75);
  EXPECT_EQ(weight_of_constant_damper(2.0), 1.0);
  EXPECT_NEAR(weight_of_hertz_damper(1.0), 1.32045, 2e-3);  // -zeta(-1/4, 2)
  EXPECT_EQ(weight_of_hertz_damper(2.0), 1.0);
  ContactState s;
  ContactHistory none, before;
  s.overlap = 1e-6, s.closing_speed = 2;
  before.normal_force = 1;
  EXPECT_DOUBLE_EQ(share_since_touch(s, none, 1e-6), 0.5);
  EXPECT_EQ(share_since_touch(s, none, 1e-7), 2);    // was there before the step
  EXPECT_EQ(share_since_touch(s, before, 1e-6), 2);  // and so was this
  s.closing_speed = -1;
  EXPECT_EQ(share_since_touch(s, none, 1e-6), 2);
}

TEST(NormalDamper, TangentialDampersTakeHalfOfASlip) {
  ContactState s;
  s.tangential_mass = 1;
  s.effective_mass = 10;  // held along the normal: of no account
  EXPECT_EQ(within_step(s, 2.0, 1.0, 2e-3), 2.0);
  EXPECT_DOUBLE_EQ(3.5 * 0.2 * within_step(s, 1e6, 1.0, 0.4), 0.25);
  EXPECT_DOUBLE_EQ(3.5 * 0.2 * within_step(s, 1e6, 0.0, 0.4), 0.25);
  EXPECT_EQ(within_step(s, 2.0, 1.0, 0.0), 0.0);  // no step, no damper
  s.tangential_damping_rate = 10;                 // ten such contacts on the same bodies
  EXPECT_DOUBLE_EQ(3.5 * 2 * within_step(s, 1e6, 1.0, 0.4), 0.25);
  EXPECT_EQ(within_step(ContactState{}, 5.0, 1.0, 0.4), 5.0);  // both held
}

/// A pack that has come to rest, of spheres that lose nearly all in an impact.
TEST(NormalDamper, APackAtRestWinsNothing) {
  PackingSpec spec;
  spec.upper = Vec3(0.12, 0.12, 0.6);
  spec.classes = {{0.02, 100, 2500, 0}};
  Particles p;
  for (const ParticleSpec& sphere : pack(spec)) p.add(sphere);
  Materials m;
  m.add({"soft", 1e6, 0.3});
  m.set_pair(0, 0, 0.5, 0.1);
  Walls walls;
  for (const auto& [point, normal] :
       {std::pair(Vec3(0, 0, 0), Vec3(0, 0, 1)), std::pair(Vec3(0, 0, 0), Vec3(1, 0, 0)),
        std::pair(Vec3(0.12, 0, 0), Vec3(-1, 0, 0)), std::pair(Vec3(0, 0, 0), Vec3(0, 1, 0)),
        std::pair(Vec3(0, 0.12, 0), Vec3(0, -1, 0))})
    walls.add({.name = "side", .shape = HalfSpace{point, normal}});
  SolidsOptions options = testing::options(0.3 * rayleigh_time_step(p, m), Vec3(0, 0, -9.81));
  options.watchdog.overlap_limit = 1;
  Solids s{p, {}, m, walls, options};
  while (s.time() < 0.4) s.advance(10);
  const double damped = s.ledger().contact_damping, total = s.ledger().total();
  while (s.time() < 0.6) s.advance(10);
  const double fall = 100 * sphere_volume(0.01) * 2500 * 9.81 * 0.01;  // of all by a radius, J
  EXPECT_LT(s.ledger().contact_damping - damped, 1e-3 * fall);
  EXPECT_LT(std::abs(s.ledger().total() - total), 1e-4 * fall);
}

}  // namespace
}  // namespace lahar::dem
