#include "coupling/lubrication.h"

#include <gtest/gtest.h>

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

/// However viscous the film, a step never turns the approach round.
TEST(Lubrication, StopsAtMost) {
  dem::Particles p = two_grains(0, 0.1);
  const double dt = 1e-3;
  add_lubrication(p, 0.01, 1e4, dt, wet);
  const double after = 0.1 + dt * (p.external_force.x[0] / p.mass[0] - p.external_force.x[1] / p.mass[1]);
  EXPECT_NEAR(after, 0, 1e-12);
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
      expected += d.norm() - 0.1 < kFilmCutOff * 0.01 && (p.velocity[i] - p.velocity[j]).dot(d / d.norm()) != 0;
    }
  EXPECT_EQ(add_lubrication(p, 0.01, 1e-3, 1e-5, wet), expected);
  EXPECT_GT(expected, 800U);
}

}  // namespace
}  // namespace lahar::coupling
