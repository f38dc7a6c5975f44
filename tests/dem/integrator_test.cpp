#include "dem/integrator.h"

#include <gtest/gtest.h>

#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

TEST(Integrator, kick_and_drift_follow_newton_and_euler) {
  Particles p;
  p.add(testing::sphere({1, 2, 3}, 0.1, 1000, {1, 0, 0}));
  p.force.set(0, {0, 2, 0});
  p.torque.set(0, {0, 0, 3});
  kick(p, 0.5);
  EXPECT_NEAR(p.velocity.y[0], 0.5 * 2 / p.mass[0], 1e-15);
  EXPECT_NEAR(p.angular_velocity.z[0], 0.5 * 3 / p.inertia[0], 1e-12);
  kick_and_drift(p, 0, 2);
  EXPECT_NEAR(p.position.x[0], 3, 1e-15);
  EXPECT_NEAR(p.position.y[0], 2 + 2 * 0.5 * 2 / p.mass[0], 1e-14);
}

TEST(Integrator, fixed_and_removed_particles_stay) {
  Particles p;
  ParticleSpec s = testing::sphere({1, 2, 3}, 0.1, 1000);
  s.state = ParticleState::fixed;
  p.add(s);
  p.add(testing::sphere({5, 5, 5}, 0.1, 1000, {1, 1, 1}));
  p.remove(1);
  for (std::size_t i : {0u, 1u}) p.force.set(i, {1, 1, 1}), p.torque.set(i, {1, 1, 1});
  kick(p, 1);
  kick_and_drift(p, 0, 1);
  EXPECT_EQ(p.position[0], Vec3(1, 2, 3));
  EXPECT_EQ(p.position[1], Vec3(5, 5, 5));
  EXPECT_EQ(p.angular_velocity[0], Vec3::Zero());
}

}  // namespace
}  // namespace lahar::dem
