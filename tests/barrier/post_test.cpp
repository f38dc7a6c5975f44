#include "barrier/post.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "barrier/link.h"
#include "core/check.h"
#include "dem/solids.h"
#include "dem/time_step.h"

namespace lahar::barrier {
namespace {

PostSection tube() {
  return {.youngs_modulus = 210e9, .area = 8.7e-4, .second_moment = 3.35e-7, .density = 7850, .damping_ratio = 0};
}

PostSpec upright(FootJoint foot) {
  PostSpec s;
  s.foot = {0, 0, 0.03}, s.head = {0, 0, 0.93};
  s.diameter = 0.06, s.section = tube(), s.foot_joint = foot, s.body = 4;
  return s;
}

TEST(Post, BondHasTheStiffnessOfTheSection) {
  const dem::BondSort sort = post_bond(tube(), 0.06);
  const double area = std::numbers::pi * sort.bond_radius * sort.bond_radius;
  EXPECT_NEAR(sort.axial.stiffness[0] * area * 0.06 / (210e9 * 8.7e-4), 1, 1e-12);
  EXPECT_NEAR(sort.axial.stiffness[0] * area * sort.bond_radius * sort.bond_radius / 4 * 0.06 / (210e9 * 3.35e-7), 1,
              1e-12);
  EXPECT_NEAR(sort.shear_stiffness / sort.axial.stiffness[0], 1 / 2.6, 1e-12);
}

TEST(Post, BeadsTouchAndCarryTheProfilesMass) {
  dem::Particles p;
  dem::Bonds b;
  const Post post = add_post(upright(FootJoint::fixed), p, b);
  ASSERT_EQ(post.wire.beads, 16u);
  EXPECT_NEAR(p.position.z[1] - p.position.z[0], 0.06, 1e-12);
  double mass = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    mass += p.mass[i];
    EXPECT_EQ(p.body[i], 4);
  }
  EXPECT_NEAR(mass, 7850 * 8.7e-4 * 0.96, 1e-9);
  EXPECT_EQ(p.state[0], dem::ParticleState::fixed);
  EXPECT_EQ(post.foot_beads, std::vector<dem::ParticleIndex>{0});
  EXPECT_NEAR(post_spacing(0.9, 0.07), 0.075, 1e-12);  // never less than a diameter
}

/// A post set spinning rigidly about its foot: a hinge lets it, without any force but the centripetal one.
TEST(Post, HingedFootTurnsFreelyAndStaysInPlace) {
  for (const Vec3& spin : {Vec3(0, 0.5, 0), Vec3(0.5, 0, 0), Vec3(0.2, 0.3, 1)}) {
    dem::Particles p;
    dem::Bonds b;
    const Post post = add_post(upright(FootJoint::hinged), p, b);
    const Vec3 foot = p.position[post.wire.first_bead];
    for (dem::ParticleIndex i = 0; i <= post.head(); ++i)
      p.velocity.set(i, spin.cross(p.position[i] - foot)), p.angular_velocity.set(i, spin);
    dem::Materials materials;
    materials.add({"steel", 1e9, 0.3});
    dem::SolidsOptions options;
    options.gravity = Vec3::Zero();
    options.time_step = 0.5 * dem::bond_time_step(b, p);
    dem::Solids solids(p, b, materials, {}, options);
    while (solids.time() < 0.1) solids.advance(100);
    const auto& q = solids.particles();
    EXPECT_LT((q.position[post.wire.first_bead] - foot).norm(), 1e-6);
    const double angle = std::hypot(spin.x(), spin.y()) * solids.time();
    EXPECT_NEAR((q.position[post.head()] - foot - Vec3(0, 0, 0.9)).norm() / (0.9 * angle), 1, 0.01);
    EXPECT_NEAR((q.position[post.head()] - foot).norm(), 0.9, 1e-5);
  }
}

TEST(Post, RefusesWhatIsNoBeam) {
  dem::Particles p;
  dem::Bonds b;
  PostSpec stout = upright(FootJoint::fixed), hollow = stout;
  stout.diameter = 0.2;
  EXPECT_THROW(add_post(stout, p, b), InputError);
  hollow.section.area = 0;
  EXPECT_THROW(add_post(hollow, p, b), InputError);
}

TEST(Link, HasAxialStiffnessAlone) {
  const dem::BondSort sort = link_bond(1e6, 0.01);
  const double area = std::numbers::pi * sort.bond_radius * sort.bond_radius;
  EXPECT_NEAR(sort.axial.stiffness[0] * area, 1e6, 1e-6);
  EXPECT_EQ(sort.shear_stiffness, 0);
  EXPECT_LT(sort.axial.stiffness[0] * area * sort.bond_radius * sort.bond_radius / 4, 1e6 * 1e-12);
}

}  // namespace
}  // namespace lahar::barrier
