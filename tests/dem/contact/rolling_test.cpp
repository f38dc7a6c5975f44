// Rolling resistance against rigid-body theory, and the properties of its law.
#include "dem/contact/rolling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/parallel.h"
#include "dem/time_step.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

RollingState state(double rolling_friction) {
  RollingState r;
  r.normal_ij = {0, 0, -1};
  r.normal_force = 10;
  r.effective_radius = 0.02;
  r.effective_inertia = 1e-4;
  r.shear_stiffness = r.last_shear_stiffness = 1e5;
  r.rolling_friction = rolling_friction;
  r.damping_ratio = 0.3;
  return r;
}

/// Any rolling: the torque stays in its cone and in the tangent plane, nothing negative is dissipated, and what the
/// spins put into the spring is there or was lost.
TEST(RollingLaw, KeepsToItsConeAndItsLedger) {
  std::mt19937 random(3);
  const auto u = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  RollingState r = state(0.2);
  Triple angle{};
  constexpr double dt = 1e-5;
  double work = 0, lost = 0, elastic = 0, damped = 0;
  Triple spring{};
  for (int n = 0; n < 5000; ++n) {
    if (n % 50 == 0) r.spin = r.spin_end = {20 * u(), 20 * u(), 20 * u()};
    const RollingTorque t = roll(r, angle, dt);
    EXPECT_LE(length(t.on_i), 0.2 * 0.02 * 10 * (1 + 1e-12));
    EXPECT_NEAR(t.on_i.z, 0, 1e-15);
    EXPECT_GE(t.damping_work, 0);
    EXPECT_GE(t.friction_work, 0);
    const Triple now = (1e5 * 0.02 * 0.02) * angle;
    work += 0.5 * dt * dot(now + spring, normal_part(r.spin, r.normal_ij));  // trapezoidal rule
    spring = now;
    elastic = t.elastic, lost += t.friction_work, damped += t.damping_work;
  }
  EXPECT_NEAR(elastic + lost, work, 1e-9 * work);
  EXPECT_GT(lost, 100 * elastic);
  EXPECT_GT(damped, 0);
}

TEST(RollingLaw, DoesNotResistTwistNorCommonSpin) {
  RollingState r = state(0.2);
  Triple angle{};
  EXPECT_EQ(length(roll(r, angle, 1e-4).on_i), 0);
  r.spin = r.spin_end = {0, 0, 30};
  EXPECT_EQ(length(roll(r, angle, 1e-4).on_i), 0);
}

TEST(RollingLaw, SpringFollowsTheRelativeRotation) {
  RollingState r = state(1e6);  // never rolls on
  r.damping_ratio = 0;
  r.spin = r.spin_end = {0, 2, 0};
  Triple angle{};
  RollingTorque t;
  for (int n = 0; n < 100; ++n) t = roll(r, angle, 1e-4);
  EXPECT_NEAR(angle.y, 0.02, 1e-15);
  EXPECT_NEAR(t.on_i.y, -1e5 * 0.02 * 0.02 * 0.02, 1e-12);  // k_r = k_t R^2
  EXPECT_NEAR(t.elastic, 0.5 * 40 * 0.02 * 0.02, 1e-12);
  EXPECT_NEAR(t.friction_work, 0, 1e-12);
  EXPECT_NEAR(left_by_rolling(r, angle, 0), t.elastic, 1e-15);
}

constexpr double kRadius = 0.02, kDensity = 2650, kFriction = 0.7;

/// A sphere on a plane of this slope (rad), sunk in as far as at rest, rolling down without slip at `speed`.
Solids sphere_on_plane(double slope, double rolling_friction, double speed) {
  Materials m = testing::one_material(70e9, 0.3, kFriction, 0.5);
  m.set_pair(0, 0, kFriction, 0.5, rolling_friction);
  const Vec3 normal(std::sin(slope), 0, std::cos(slope)), down(std::cos(slope), 0, -std::sin(slope));
  const double weight = 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3) * kDensity * 9.81 * std::cos(slope);
  const double overlap = std::pow(weight / (4.0 / 3 * m.pair(0, 0).effective_modulus * std::sqrt(kRadius)), 2.0 / 3);
  ParticleSpec s = testing::sphere((kRadius - overlap) * normal, kRadius, kDensity, speed * down);
  s.angular_velocity = Vec3(0, speed / kRadius, 0);
  Particles p;
  p.add(s);
  const double step = 0.2 * rayleigh_time_step(kRadius, kDensity, m[0]);
  return {p, {}, m, testing::ground(normal), testing::options(step, Vec3(0, 0, -9.81))};
}

double way_down(const Solids& s, double slope) {
  return s.particles().position[0].dot(Vec3(std::cos(slope), 0, -std::sin(slope)));
}

/// Torque balance about the contact: 7/5 m R^2 w' = m g R sin - mu_r R m g cos, so a = 5/7 g (sin - mu_r cos).
TEST(Rolling, AboveItsAngleASphereAcceleratesByFiveSeventhsOfTheRest) {
  const double slope = 20 * std::numbers::pi / 180;
  for (const double rolling_friction : {0.1, 0.3}) {
    Solids s = sphere_on_plane(slope, rolling_friction, 0);
    const Vec3 down(std::cos(slope), 0, -std::sin(slope));
    s.advance(1000);  // the spring is wound up in a tenth of this
    const double start = s.particles().velocity[0].dot(down), time = s.time();
    s.advance(10000);
    const double a = 5.0 / 7 * 9.81 * (std::sin(slope) - rolling_friction * std::cos(slope));
    const double speed = s.particles().velocity[0].dot(down);
    EXPECT_NEAR((speed - start) / (s.time() - time), a, 1e-3 * a);
    EXPECT_NEAR(s.particles().angular_velocity.y[0] * kRadius, speed, 1e-3 * speed);
    // Lost: torque x angle. The work of the weight is 7/10 m v^2 and this.
    const double normal_force = s.particles().mass[0] * 9.81 * std::cos(slope);
    EXPECT_NEAR(s.ledger().rolling / (rolling_friction * normal_force * way_down(s, slope)), 1, 1e-2);
  }
}

/// Below tan(slope) = mu_r it stays where it is; without resistance it would be 7 mm further by then.
TEST(Rolling, BelowItsAngleASphereRests) {
  const double slope = 20 * std::numbers::pi / 180;
  Solids s = sphere_on_plane(slope, 0.38, 0);  // tan 20 = 0.364
  s.advance(20000);
  EXPECT_LT(std::abs(way_down(s, slope)), 1e-6);
  EXPECT_LT(s.particles().velocity[0].norm(), 1e-7);
  EXPECT_GT(s.ledger().elastic_rolling, 0);
}

/// On the level: v0^2 = 2 (5/7 mu_r g) way.
TEST(Rolling, ARollingSphereStopsAfterItsWay) {
  Solids s = sphere_on_plane(0, 0.4, 0.1);
  s.advance(20000);
  EXPECT_NEAR(way_down(s, 0) / (0.7 * 0.01 / (0.4 * 9.81)), 1, 2e-3);
  EXPECT_LT(s.particles().velocity[0].norm(), 1e-7);
  // All its energy, 7/10 m v0^2, went into rolling, but for what the dashpot took as the spring was wound up.
  EXPECT_NEAR(s.ledger().rolling / (0.7 * s.particles().mass[0] * 0.01), 1, 1e-2);
}

/// Grains that fall and settle: the ledger closes with both terms of rolling in it, whatever the number of threads.
TEST(Rolling, AHeapClosesItsLedger) {
  Materials m = testing::one_material(1e7, 0.25, 0.5, 0.5);
  m.set_pair(0, 0, 0.5, 0.5, 0.2);
  const double step = 0.1 * rayleigh_time_step(0.02, 2650, m[0]);
  const auto heap = [&] {
    return Solids(testing::loose_grains(4, 4, 4, 0.02, 0.04, 4), {}, m, testing::open_box({0.33, 0.33, 1}),
                  testing::options(step, {0, 0, -9.81}));
  };
  Solids s = heap();
  s.advance(1);
  const EnergyLedger first = s.ledger();
  s.advance(static_cast<int>(0.3 / step));
  const EnergyLedger last = s.ledger();
  const double exchanged = first.gravitational - last.gravitational;
  EXPECT_NEAR(last.total(), first.total(), 1e-3 * exchanged);
  EXPECT_GT(last.rolling, 0.01 * exchanged);
  EXPECT_GT(last.elastic_rolling, 0);
  const ThreadLimit limit(1);
  Solids alone = heap();
  alone.advance(static_cast<int>(s.step_count()));
  EXPECT_EQ(alone.particles().position[7], s.particles().position[7]);
  EXPECT_EQ(alone.ledger().rolling, last.rolling);
}

/// Dashpots of many contacts on one grain, nearly dead: each would take what the others take as well.
TEST(Rolling, DashpotsOfACrowdMakeNoEnergy) {
  for (const double restitution : {0.1, 0.3}) {
    Materials m = testing::one_material(1e7, 0.25, 0.5, restitution);
    m.set_pair(0, 0, 0.5, restitution, 0.3);
    const double step = 0.14 * rayleigh_time_step(0.02, 2650, m[0]);
    Solids s(testing::loose_grains(4, 4, 4, 0.02, 0.04, 4), {}, m, testing::open_box({0.33, 0.33, 1}),
             testing::options(step, {0, 0, -9.81}));
    s.advance(1);
    const EnergyLedger first = s.ledger();
    s.advance(static_cast<int>(0.3 / step));
    const EnergyLedger last = s.ledger();
    const double exchanged = first.gravitational - last.gravitational;
    EXPECT_NEAR(last.total(), first.total(), 0.01 * exchanged) << restitution;
    EXPECT_LT(last.kinetic + last.rotational, 0.1 * exchanged) << restitution;
  }
}

/// What i feels, j feels the other way round.
TEST(Rolling, KeepsAngularMomentum) {
  Materials m = testing::one_material(1e7, 0.25, 0.5, 0.5);
  m.set_pair(0, 0, 0.5, 0.5, 0.3);
  const Particles p = testing::random_cloud(0, 0.02, 60, 0.012, Vec3(0.15, 0.15, 0.15), 0.5, 9);
  SolidsOptions options = testing::options(2e-5);
  options.watchdog.overlap_limit = 2;  // places are random
  Solids s(p, {}, m, {}, options);
  const Vec3 before = angular_momentum(s.particles());
  s.advance(300);
  EXPECT_GT(s.ledger().rolling, 0);
  EXPECT_LT((angular_momentum(s.particles()) - before).norm(), 1e-12);
}

}  // namespace
}  // namespace lahar::dem
