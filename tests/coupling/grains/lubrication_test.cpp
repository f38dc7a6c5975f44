#include "coupling/grains/lubrication.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <random>

#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

dem::Particles two_grains(double gap, double speed) {
  dem::Particles p;
  p.add(grain(Vec3(-0.05 - gap / 2, 0, 0), 0.05, 2500));
  p.add(grain(Vec3(0.02 + gap / 2, 0, 0), 0.02, 2500));
  p.velocity.set(0, Vec3(speed, 0.3, 0));
  p.velocity.set(1, Vec3(0, 0.3, 0));
  return p;
}

bool wet(const Vec3&) { return true; }
bool dry(const Vec3&) { return false; }

/// The films of the particles where they are.
std::size_t add_lubrication(dem::Particles& p, double cell_size, double viscosity, double time_step,
                            const std::function<bool(const Vec3&)>& is_wet, const Walls& walls = {}) {
  LubricationFilms films(cell_size, viscosity);
  films.find(p, walls, time_step, is_wet);
  return films.add(p, walls, time_step);
}

/// 6 pi mu R*^2 v / h for a gap far below the cut-off, and nothing beyond it.
TEST(Lubrication, FollowsTheLawOfTheFilm) {
  const double reduced = 0.05 * 0.02 / 0.07, mu = 1e-3, h = 1e-4, cell = 0.01;
  dem::Particles p = two_grains(h, 0.1);
  EXPECT_EQ(add_lubrication(p, cell, mu, 1e-5, wet), 1U);
  const double expected = 6 * std::numbers::pi * mu * reduced * reduced * (1 / h - 1 / (kFilmCutOff * cell)) * 0.1;
  EXPECT_NEAR(p.external_force.x[0] / -expected, 1, 1e-9);
  EXPECT_EQ(p.external_force[0], Vec3(-p.external_force[1]));
  EXPECT_EQ(p.external_force.y[0], 0);
  dem::Particles far = two_grains(0.7 * cell, 0.1), in_air = two_grains(h, 0.1);
  EXPECT_EQ(add_lubrication(far, cell, mu, 1e-5, wet), 0U);
  EXPECT_EQ(add_lubrication(in_air, cell, mu, 1e-5, dry), 0U);
  EXPECT_EQ(far.external_force[0], Vec3::Zero());
}

/// Sums of what two grains get: force, torque about the origin, power.
struct Balance {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  double power = 0;
};
Balance balance_of(const dem::Particles& p) {
  Balance b;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 force = p.external_force[i], torque = p.external_torque[i];
    b.force += force;
    b.torque += torque + Vec3(p.position[i]).cross(force);
    b.power += force.dot(Vec3(p.velocity[i])) + torque.dot(Vec3(p.angular_velocity[i]));
  }
  return b;
}

/// Leading terms of Jeffrey & Onishi 1984 (Kim & Karrila 1991, sec. 11.2.2) for unequal spheres, k = b / a:
/// Y^A_11 = 4 k (2 + k + 2 k^2) / (15 (1 + k)^3) L, Y^B_11 = -k (4 + k) / (5 (1 + k)^2) L,
/// Y^C_11 = 2 k / (5 (1 + k)) L.
TEST(Lubrication, ShearsAndRollsByJeffreyAndOnishi) {
  const double a = 0.05, b = 0.02, k = b / a, mu = 1e-3, h = 1e-6, cell = 0.01, v = 0.1, pi = std::numbers::pi;
  const double log = std::log(kShearCutOff * cell / (kSmoothest * a * b / (a + b)));
  const double ya = 4 * k * (2 + k + 2 * k * k) / (15 * std::pow(1 + k, 3)) * log;
  const double yb = -k * (4 + k) / (5 * (1 + k) * (1 + k)) * log, yc = 2 * k / (5 * (1 + k)) * log;
  dem::Particles slides = two_grains(h, 0);
  slides.velocity.set(0, Vec3(0, 0.3 + v, 0));
  EXPECT_EQ(add_lubrication(slides, cell, mu, 1e-7, wet), 1U);
  // 1e-4: the gap counts in the distance of the centres
  EXPECT_NEAR(slides.external_force.y[0] / (-6 * pi * mu * a * ya * v), 1, 1e-4);
  EXPECT_NEAR(std::abs(slides.external_torque.z[0] / (4 * pi * mu * a * a * yb * v)), 1, 1e-4);
  EXPECT_LT(slides.external_torque.z[0], 0);  // the slower neighbour on the right drags its side back
  dem::Particles spins = two_grains(h, 0);
  spins.angular_velocity.set(0, Vec3(5.0, 0, 2.0));  // twisting about the line of centres is free
  add_lubrication(spins, cell, mu, 1e-7, wet);
  EXPECT_NEAR(spins.external_torque.z[0] / (-8 * pi * mu * a * a * a * yc * 2), 1, 1e-9);
  EXPECT_NEAR(
      spins.external_torque.z[1] / (-pi * mu * std::pow(a + b, 3) * 4 * k * k / (5 * std::pow(1 + k, 4)) * log * 2), 1,
      1e-9);
  EXPECT_NEAR(std::abs(spins.external_force.y[0] / (4 * pi * mu * a * a * yb * 2)), 1, 1e-4);
  EXPECT_EQ(spins.external_torque.x[0], 0);
  // Beyond the cut-off of shearing the film is squeezed alone.
  dem::Particles wide = two_grains(0.55 * cell, 0.1);
  wide.velocity.set(1, Vec3(0, 0.1, 0));
  wide.angular_velocity.set(1, Vec3(0, 0, 3));
  EXPECT_EQ(add_lubrication(wide, cell, mu, 1e-7, wet), 1U);
  EXPECT_LT(wide.external_force.x[0], 0);
  EXPECT_EQ(wide.external_force.y[0], 0);
  EXPECT_EQ(wide.external_torque[1], Vec3::Zero());
}

/// A pair that turns like a rigid body feels nothing; any motion keeps momentum and angular momentum and gains nothing.
TEST(Lubrication, PairIsFreeToTurnAndLosesEnergy) {
  const Vec3 turn(3, -2, 5), drift(0.2, 0.1, -0.4);
  dem::Particles rigid = two_grains(1e-4, 0);
  rigid.position.set(1, Vec3(rigid.position[0]) + 0.0701 * Vec3(1, 2, -1).normalized());
  for (std::size_t i = 0; i < 2; ++i) {
    rigid.velocity.set(i, drift + turn.cross(Vec3(rigid.position[i])));
    rigid.angular_velocity.set(i, turn);
  }
  dem::Particles counter = rigid;
  counter.angular_velocity.set(1, -turn);
  add_lubrication(rigid, 0.01, 1e-3, 1e-7, wet);
  add_lubrication(counter, 0.01, 1e-3, 1e-7, wet);
  const double scale = Vec3(counter.external_torque[0]).norm();
  EXPECT_GT(scale, 0);
  EXPECT_LT(Vec3(rigid.external_torque[0]).norm(), 1e-12 * scale);
  EXPECT_LT(Vec3(rigid.external_force[0]).norm(), 1e-12 * Vec3(counter.external_force[0]).norm());
  for (int k = 0; k < 50; ++k) {
    dem::Particles p = two_grains(1e-5 * (k + 1), 0.02 * (k % 3));
    p.position.set(1,
                   Vec3(p.position[0]) + (0.07 + 1e-5 * (k + 1)) * Vec3(1, std::sin(k), std::cos(3 * k)).normalized());
    p.velocity.set(1, Vec3(std::sin(7 * k), std::cos(5 * k), std::sin(k + 1)));
    p.angular_velocity.set(0, 9 * Vec3(std::cos(k), std::sin(2 * k), std::sin(3 * k)));
    p.angular_velocity.set(1, 9 * Vec3(std::cos(4 * k), std::sin(5 * k), std::sin(6 * k)));
    add_lubrication(p, 0.01, 1e-3, 1e-7, wet);
    const Balance b = balance_of(p);
    const double force = Vec3(p.external_force[0]).norm();
    EXPECT_LT(b.force.norm(), 1e-15 * force);
    EXPECT_LT(b.torque.norm(), 1e-13 * force);
    EXPECT_LT(b.power, 0);
  }
}

/// However viscous the film, a step never turns the motion past each other round.
TEST(Lubrication, ShearStopsAtMost) {
  for (const bool spins : {false, true}) {
    dem::Particles p = two_grains(0, 0);
    if (spins)
      p.angular_velocity.set(1, Vec3(0, 4, 3));
    else
      p.velocity.set(1, Vec3(0, 1, 0.5));
    const auto energy = [&] {
      double sum = 0;
      for (std::size_t i = 0; i < 2; ++i)
        sum += p.mass[i] * (Vec3(p.velocity[i]) - Vec3(0, 0.3, 0)).squaredNorm() +
               p.inertia[i] * Vec3(p.angular_velocity[i]).squaredNorm();
      return sum;
    };
    const double before = energy(), dt = 1e-3;
    add_lubrication(p, 0.01, 1e6, dt, wet);
    for (std::size_t i = 0; i < 2; ++i) {
      p.velocity.add(i, dt / p.mass[i] * Vec3(p.external_force[i]));
      p.angular_velocity.add(i, dt / p.inertia[i] * Vec3(p.external_torque[i]));
    }
    EXPECT_LT(energy(), before);
  }
}

/// However viscous the film, a step never turns the approach round.
TEST(Lubrication, StopsAtMost) {
  dem::Particles p = two_grains(0, 0.1);
  const double dt = 1e-3;
  add_lubrication(p, 0.01, 1e4, dt, wet);
  const double after = 0.1 + dt * (p.external_force.x[0] / p.mass[0] - p.external_force.x[1] / p.mass[1]);
  EXPECT_NEAR(after, 0, 1e-12);
}

/// Twelve films on each grain, each strong enough to stop it alone: all together win no energy either.
TEST(Lubrication, CrowdsOfFilmsWinNoEnergy) {
  for (const double viscosity : {0.1, 10.0, 1e4}) {
    constexpr double radius = 0.005, gap = 1e-5, dt = 1e-4, apart = 2 * radius + gap;
    dem::Particles p;
    std::mt19937 random(5);
    const auto u = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    for (int x = 0; x < 6; ++x)
      for (int y = 0; y < 6; ++y)
        for (int z = 0; z < 6; ++z) {
          if ((x + y + z) % 2) continue;  // face-centred
          p.add(grain(apart / std::numbers::sqrt2 * Vec3(x, y, z), radius, 2500));
          p.velocity.set(p.size() - 1, Vec3(u(), u(), u()));
          p.angular_velocity.set(p.size() - 1, Vec3(u(), u(), u()) / radius);
        }
    const auto energy = [&] {
      double sum = 0;
      for (std::size_t i = 0; i < p.size(); ++i)
        sum += p.mass[i] * Vec3(p.velocity[i]).squaredNorm() + p.inertia[i] * Vec3(p.angular_velocity[i]).squaredNorm();
      return sum;
    };
    double before = energy();
    for (int s = 0; s < 60; ++s) {  // held in place
      p.external_force.fill(Vec3::Zero()), p.external_torque.fill(Vec3::Zero());
      add_lubrication(p, 0.002, viscosity, dt, wet);
      for (std::size_t i = 0; i < p.size(); ++i) {
        p.velocity.add(i, dt / p.mass[i] * Vec3(p.external_force[i]));
        p.angular_velocity.add(i, dt / p.inertia[i] * Vec3(p.external_torque[i]));
      }
      const double now = energy();
      ASSERT_LE(now, before * (1 + 1e-9)) << viscosity << ' ' << s;
      before = now;
    }
  }
}

/// The boxes find every pair that a search over all pairs finds.
TEST(Lubrication, FindsAllPairs) {
  dem::Particles p;
  std::size_t expected = 0;
  for (int k = 0; k < 343; ++k) p.add(grain(0.101 * Vec3(k % 7 - 3, k / 7 % 7 - 3, k / 49 - 3), 0.05, 2500));
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity.set(i, Vec3(0.01 * double(i), 0.02 * double(i % 5), 1.0 / double(i + 1)));
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      const Vec3 d = p.position[j] - p.position[i];
      const Vec3 slip = p.velocity[j] - p.velocity[i];
      expected += d.norm() - 0.1 < kFilmCutOff * 0.01 && slip.norm() > 0;
    }
  EXPECT_EQ(add_lubrication(p, 0.01, 1e-3, 1e-5, wet), expected);
  EXPECT_GT(expected, 800U);
}

Walls floor_at(double z, const Vec3& velocity = Vec3::Zero()) {
  Walls walls;
  Wall floor{"floor", HalfSpace{Vec3(0, 0, z), Vec3::UnitZ()}};
  floor.velocity = velocity;
  walls.add(floor);
  return walls;
}

/// A wall is what a sphere becomes that grows without bound: forces and torques on the grain are the same.
TEST(Lubrication, WallIsALargeSphere) {
  const double a = 0.02, h = 2e-4, cell = 0.01, mu = 1e-3, huge = 1e4;
  const auto moving = [&](const Vec3& place) {
    dem::Particles p;
    p.add(grain(place, a, 2500));
    p.velocity.set(0, Vec3(0.2, -0.1, -0.3));
    p.angular_velocity.set(0, Vec3(3, -2, 4));
    return p;
  };
  dem::Particles at_wall = moving(Vec3(0, 0, a + h)), at_sphere = moving(Vec3(0, 0, a + h));
  dem::ParticleSpec sphere = grain(Vec3(0, 0, -huge), huge, 2500);
  sphere.state = dem::ParticleState::fixed;
  at_sphere.add(sphere);
  EXPECT_EQ(add_lubrication(at_wall, cell, mu, 1e-7, wet, floor_at(0)), 1U);
  EXPECT_EQ(add_lubrication(at_sphere, cell, mu, 1e-7, wet), 1U);
  const Vec3 force = at_wall.external_force[0], torque = at_wall.external_torque[0];
  EXPECT_GT(force.z(), 0);
  EXPECT_LT((force - Vec3(at_sphere.external_force[0])).norm(), 1e-4 * force.norm());
  EXPECT_LT((torque - Vec3(at_sphere.external_torque[0])).norm(), 1e-4 * torque.norm());
}

/// Squeezing at a ball is that of a pair; at a cylinder Reynolds' equation in a gap of curvatures k and k' has
/// 12 pi mu v / ((k + k') sqrt(k k') h).
TEST(Lubrication, WallsAreCurved) {
  const double a = 0.02, radius = 0.03, h = 1e-4, cell = 0.01, mu = 1e-3, v = 0.1, pi = std::numbers::pi;
  const auto push_at = [&](const Shape& shape, double height) {
    Walls walls;
    walls.add({"wall", shape});
    dem::Particles p;
    p.add(grain(Vec3(0, 0, height), a, 2500));
    p.velocity.set(0, Vec3(0, 0, -v));
    EXPECT_EQ(add_lubrication(p, cell, mu, 1e-9, wet, walls), 1U);
    return p.external_force.z[0] / (1 / h - 1 / (kFilmCutOff * cell));
  };
  const double reduced = a * radius / (a + radius);
  EXPECT_NEAR(push_at(SolidSphere{Vec3::Zero(), radius}, radius + a + h) / (6 * pi * mu * v * reduced * reduced), 1,
              1e-6);
  const auto between = [&](double k, double l) { return 12 * pi * mu * v / ((k + l) * std::sqrt(k * l)); };
  const SolidCylinder bar{Vec3(-1, 0, 0), Vec3(1, 0, 0), radius};
  EXPECT_NEAR(push_at(bar, radius + a + h) / between(1 / a, 1 / a + 1 / radius), 1, 1e-6);
  SolidCylinder bore = bar;
  bore.hollow = true;
  EXPECT_NEAR(push_at(bore, -(radius - a - h)) / between(1 / a, 1 / a - 1 / radius), 1, 1e-6);
}

/// Goldman, Cox & Brenner 1967: 8/15 ln, 2/15 ln and 2/5 ln. A sphere that moves with its wall feels nothing, one that
/// slides is made to roll.
TEST(Lubrication, SlidesAndRollsAtAWall) {
  const double a = 0.02, h = 1e-4, cell = 0.01, mu = 1e-3, v = 0.1, pi = std::numbers::pi;
  const double log = std::log(kShearCutOff * cell / h);
  dem::Particles slides, rides, far, above;
  for (dem::Particles* p : {&slides, &rides, &far}) {
    p->add(grain(Vec3(0, 0, a + h), a, 2500));
    p->velocity.set(0, Vec3(v, 0, 0));
  }
  far.position.set(0, Vec3(0, 0, a + 0.7 * cell));
  add_lubrication(slides, cell, mu, 1e-7, wet, floor_at(0));
  EXPECT_NEAR(slides.external_force.x[0] / (-6 * pi * mu * a * v * 8 / 15 * log), 1, 1e-9);
  EXPECT_NEAR(slides.external_torque.y[0] / (6 * pi * mu * a * a * v * 2 / 15 * log), 1, 1e-9);
  EXPECT_EQ(add_lubrication(rides, cell, mu, 1e-7, wet, floor_at(0, Vec3(v, 0, 0))), 0U);
  EXPECT_EQ(add_lubrication(far, cell, mu, 1e-7, wet, floor_at(0)), 0U);
  EXPECT_EQ(rides.external_force[0], Vec3::Zero());
  dem::Particles spins;
  spins.add(grain(Vec3(0, 0, a + h), a, 2500));
  spins.angular_velocity.set(0, Vec3(0, 5, 7));
  add_lubrication(spins, cell, mu, 1e-7, wet, floor_at(0));
  EXPECT_NEAR(spins.external_torque.y[0] / (-8 * pi * mu * a * a * a * 5 * 2 / 5 * log), 1, 1e-9);
  EXPECT_NEAR(spins.external_force.x[0] / (6 * pi * mu * a * a * 5 * 2 / 15 * log), 1, 1e-9);
  EXPECT_EQ(spins.external_torque.z[0], 0);
}

/// Films are felt at the places of now: the squeezing of a gap that closes from h_c to h_min takes ln(h_c / h_min) - 1
/// of the Stokes number, however long the step in which the film was found.
TEST(Lubrication, TakesItsShareOfTheStokesNumber) {
  const double a = 0.02, cell = 0.01, mu = 1.0, hc = kFilmCutOff * cell, hmin = kSmoothest * a, dt = 1e-6;
  dem::Particles p;
  p.add(grain(Vec3(0, 0, a + 0.999 * hc), a, 2500));
  const double unit = 6 * std::numbers::pi * mu * a * a / p.mass[0];  // speed for a unit of the Stokes number
  const double first = 12 * unit;
  p.velocity.set(0, Vec3(0, 0, -first));
  LubricationFilms films(cell, mu);
  const Walls floor = floor_at(0);
  films.find(p, floor, 1, wet);
  while (p.position.z[0] - a > hmin) {
    p.external_force.fill(Vec3::Zero());
    films.add(p, floor, dt);
    p.velocity.add(0, dt / p.mass[0] * Vec3(p.external_force[0]));
    p.position.add(0, dt * Vec3(p.velocity[0]));
  }
  const double lost = (first + p.velocity.z[0]) / unit;
  EXPECT_NEAR(lost, std::log(hc / hmin) - (1 - hmin / hc), 0.02);
}

}  // namespace
}  // namespace lahar::coupling
