// The contact loop: geometry, action and reaction, who touches whom.
#include "dem/contact/contact_forces.h"

#include <gtest/gtest.h>

#include "dem/contact/worst_overlap.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

using testing::one_material;
using testing::sphere;

struct Scene {
  Particles particles;
  Walls walls;
  Materials materials;
  ContactDetection contacts{};
  ContactForces forces{materials, HertzMindlin{}};

  /// Elastic by default: a damper would feel the speed that the springs give to what is not held.
  explicit Scene(double restitution = 1) : materials(one_material(1e7, 0.25, 0.5, restitution)) {}

  void compute(double dt = 1e-5) {
    contacts.rebuild(particles, walls, {});
    forces.compute(particles, contacts, walls, Vec3::Zero(), dt);
  }
};

double hertz(const MaterialPair& pair, double radius, double overlap) {
  return 4.0 / 3 * pair.effective_modulus * std::sqrt(radius) * std::pow(overlap, 1.5);
}

TEST(ContactForces, unequal_spheres_at_rest_feel_hertz) {
  Scene s;
  const Vec3 n = Vec3(1, 2, 2) / 3;
  s.particles.add(sphere(Vec3::Zero(), 0.04, 2650));
  s.particles.add(sphere(0.0495 * n, 0.01, 2650));
  s.compute();
  const double expected = hertz(s.materials.pair(0, 0), 0.008, 0.0005);
  EXPECT_LT((s.particles.force[1] - expected * n).norm(), 1e-9 * expected);
  EXPECT_LT((s.particles.force[0] + expected * n).norm(), 1e-9 * expected);
  EXPECT_LT(s.particles.torque[0].norm(), 1e-12);
  EXPECT_NEAR(worst_overlap(s.particles, s.contacts, s.walls).ratio, 0.05, 1e-9);
}

/// Spheres of two materials that slide on each other have the friction and the stiffness of their pair, whichever comes
/// first; one on a wall likewise.
TEST(ContactForces, materials_that_differ_have_what_their_pair_has) {
  for (const bool swapped : {false, true}) {
    Scene s;
    s.materials = {};
    s.materials.add({"soft", 1e7, 0.3}), s.materials.add({"hard", 8e7, 0.2});
    s.materials.set_pair(0, 0, 0.1, 1), s.materials.set_pair(1, 1, 0.9, 1), s.materials.set_pair(0, 1, 0.4, 1);
    s.forces = ContactForces{s.materials, HertzMindlin{}};
    ParticleSpec soft = sphere({0, 0, 0.5}, 0.02, 2650), hard = sphere({0, 0, 0.539}, 0.02, 2650, {300, 0, 0});
    ParticleSpec on_wall = sphere({1, 0, 0.019}, 0.02, 2650, {300, 0, 0});
    hard.material = on_wall.material = 1;
    s.particles.add(swapped ? hard : soft), s.particles.add(swapped ? soft : hard), s.particles.add(on_wall);
    s.walls = testing::ground();  // of the soft material
    s.compute();
    const double force = hertz(s.materials.pair(0, 1), 0.01, 0.001),
                 at_wall = hertz(s.materials.pair(0, 1), 0.02, 0.001);
    const Vec3 on_hard = s.particles.force[swapped ? 0 : 1];
    EXPECT_NEAR(on_hard.z() / force, 1, 1e-9);
    EXPECT_NEAR(on_hard.x() / force, -0.4, 1e-9);
    EXPECT_NEAR(s.particles.force[2].z() / at_wall, 1, 1e-9);
    EXPECT_NEAR(s.particles.force[2].x() / at_wall, -0.4, 1e-9);
  }
}

TEST(ContactForces, nothing_at_zero_overlap) {
  Scene s;
  s.walls = testing::ground();
  s.particles.add(sphere({0, 0, 0.5}, 0.5, 2650, {0, 0, -1}));
  s.particles.add(sphere({1, 0, 0.5}, 0.5, 2650, {-1, 0, 0}));
  s.compute();
  EXPECT_EQ(s.particles.force[0], Vec3::Zero());
  EXPECT_EQ(s.particles.force[1], Vec3::Zero());
}

/// Spheres that just graze: whether they touch is judged on squares, and rounding may leave no overlap at all. Among
/// many directions some do; none may give a force that is not a number.
TEST(ContactForces, grazing_contacts_are_finite) {
  int touching = 0;
  for (int k = 1; k <= 20000; ++k) {
    const Vec3 n = Vec3(std::sin(1.1 * k), std::cos(1.7 * k), std::sin(2.3 * k)).normalized();
    const double distance = (0.04 + 0.02) * (1 - 1e-16 * (k % 3));
    Scene s;
    s.particles.add(sphere(Vec3(0.1, 0.2, 0.3), 0.04, 2650, n));
    s.particles.add(sphere(Vec3(0.1, 0.2, 0.3) + distance * n, 0.02, 2650));
    s.compute();
    ASSERT_TRUE(s.particles.force[0].allFinite() && s.particles.torque[1].allFinite()) << k;
    touching += s.contacts.pairs().touching.empty() ? 0 : s.contacts.pairs().touching[0];
  }
  EXPECT_GT(touching, 100);
}

TEST(ContactForces, walls_push_along_their_gradient_also_when_a_centre_is_behind_them) {
  Scene s;
  s.walls = testing::ground(Vec3(0.6, 0, 0.8));
  s.particles.add(sphere(0.019 * Vec3(0.6, 0, 0.8), 0.02, 2650));
  s.particles.add(sphere(Vec3(0.8, 0, -0.6) - 0.001 * Vec3(0.6, 0, 0.8), 0.02, 2650));
  s.compute();
  const MaterialPair& pair = s.materials.pair(0, 0);
  const Vec3 n(0.6, 0, 0.8);
  EXPECT_LT((s.particles.force[0] - hertz(pair, 0.02, 0.001) * n).norm(), 1e-6);
  EXPECT_LT((s.particles.force[1] - hertz(pair, 0.02, 0.021) * n).norm(), 1e-6);
  EXPECT_LT((s.forces.force_on_wall(s.particles, s.contacts, 0) + s.particles.force[0] + s.particles.force[1]).norm(),
            1e-9);
}

TEST(ContactForces, a_corner_pushes_with_each_wall) {
  Scene s;
  s.walls = testing::open_box({1, 1, 1});
  s.particles.add(sphere({0.0195, 0.5, 0.019}, 0.02, 2650));
  s.compute();
  const MaterialPair& pair = s.materials.pair(0, 0);
  EXPECT_NEAR(s.particles.force.x[0], hertz(pair, 0.02, 0.0005), 1e-9);
  EXPECT_NEAR(s.particles.force.z[0], hertz(pair, 0.02, 0.001), 1e-9);
}

TEST(ContactForces, action_is_reaction_and_torques_balance) {
  Scene s(0.6);
  s.particles = testing::random_cloud(30, 0.04, 400, 0.01, {0.4, 0.4, 0.4}, 0.5, 9);
  s.compute();
  s.compute();  // once more with springs under load
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  double size = 0, turning = 0;
  for (std::size_t i = 0; i < s.particles.size(); ++i) {
    force += s.particles.force[i];
    torque += s.particles.torque[i] + s.particles.position[i].cross(s.particles.force[i]);
    size += s.particles.force[i].norm();
    turning += s.particles.torque[i].norm();
  }
  EXPECT_GT(turning, 1);
  EXPECT_LT(force.norm(), 1e-13 * size);
  EXPECT_LT(torque.norm(), 1e-13 * size);
}

TEST(ContactForces, friction_acts_against_sliding_with_the_right_arm) {
  Scene s;
  s.particles.add(sphere({0, 0, 0}, 0.02, 2650));
  s.particles.add(sphere({0.0398, 0, 0}, 0.02, 2650, {0, 100, 0}));
  s.compute();
  const double normal = hertz(s.materials.pair(0, 0), 0.01, 0.0002);
  EXPECT_NEAR(s.particles.force.y[0], 0.5 * normal, 1e-9 * normal);   // dragged along
  EXPECT_NEAR(s.particles.force.y[1], -0.5 * normal, 1e-9 * normal);  // held back
  EXPECT_NEAR(s.particles.torque.z[0], 0.0199 * 0.5 * normal, 1e-9 * normal);
  EXPECT_NEAR(s.particles.torque.z[1], 0.0199 * 0.5 * normal, 1e-9 * normal);
}

TEST(ContactForces, beads_of_one_body_touch_without_friction) {
  for (const int other_body : {4, 5}) {
    Scene s;
    ParticleSpec bead = sphere({0, 0, 0}, 0.02, 2650);
    bead.body = 4;
    s.particles.add(bead);
    bead.body = other_body;
    bead.position.x() = 0.0398;
    bead.velocity.y() = 1;
    s.particles.add(bead);
    s.compute();
    EXPECT_EQ(s.particles.force.y[0] != 0, other_body == 5);
    EXPECT_LT(s.particles.force.x[0], 0);
  }
}

TEST(ContactForces, removed_particles_are_inert_and_forget) {
  Scene s;
  s.particles.add(sphere({0, 0, 0}, 0.02, 2650));
  s.particles.add(sphere({0.039, 0, 0}, 0.02, 2650, {0, 1, 0}));
  s.compute();
  EXPECT_EQ(s.contacts.stored_contacts(s.particles).size(), 1u);
  s.particles.remove(1);
  s.forces.compute(s.particles, s.contacts, s.walls, Vec3(0, 0, -9.81), 1e-5);  // the lists still hold it
  EXPECT_EQ(s.particles.force[1], Vec3::Zero());
  EXPECT_EQ(s.particles.force.x[0], 0);
  EXPECT_EQ(s.contacts.stored_contacts(s.particles).size(), 0u);
}

TEST(ContactForces, moving_wall_drags_particles_and_works_on_them) {
  Scene s;
  s.walls.add({"belt", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::no_slip, 0, Vec3(2, 0, 0)});
  s.particles.add(sphere({0, 0, 0.0199}, 0.02, 2650));
  s.compute(1e-3);
  const double drag = 0.5 * hertz(s.materials.pair(0, 0), 0.02, 0.0001);
  EXPECT_NEAR(s.particles.force.x[0], drag, 1e-9);
  EXPECT_NEAR(s.forces.energy().wall_work, drag * 2 * 1e-3, 1e-12);
}

}  // namespace
}  // namespace lahar::dem
