#include "barrier/response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lahar::barrier {
namespace {

RingNetSpec small_spec() {
  RingNetSpec spec;
  spec.width = 0.24, spec.height = 0.18;
  spec.fit = NetFit::cables_on_frame;
  return spec;
}

struct Built {
  dem::Particles particles;
  dem::Bonds bonds;
  Net net;
  Built() { net = build_net(small_spec(), particles, bonds); }
  [[nodiscard]] BarrierResponse look() const { return response(net, particles, bonds, {0, 0, -10}); }
};

/// The links of a ball joint are no part of what posts bear, but hold energy as their bonds do.
TEST(Response, JointsAreNoPartOfThePosts) {
  dem::Particles particles;
  dem::Bonds bonds;
  PostSpec spec;
  spec.foot = {0, 0, 0.03}, spec.head = {0, 0, 0.93};
  spec.section = {
      .youngs_modulus = 210e9, .area = 8.7e-4, .second_moment = 3.35e-7, .density = 7850, .damping_ratio = 0};
  spec.diameter = 0.06, spec.foot_joint = FootJoint::hinged;
  Net net;
  net.posts.push_back(add_post(spec, particles, bonds));
  net.beads = particles.size(), net.bonds = bonds.size();
  note_beads_since(0, particles, net);
  ASSERT_FALSE(net.posts[0].joint.empty());
  for (const std::size_t b : net.posts[0].joint) bonds.axial_force[b] = 1272, bonds.elongation[b] = 1e-6;
  bonds.axial_force[net.posts[0].wire.first_bond] = 14;
  const BarrierResponse r = response(net, particles, bonds, {0, 0, -10});
  EXPECT_EQ(r[Component::posts].max_tension, 14);
  EXPECT_EQ(r[Component::posts].force_sum, 14);
  EXPECT_EQ(r[Component::barrier].max_tension, 14);
  EXPECT_GT(r[Component::posts].energy.elastic(), 0);
}

TEST(Response, NetAtRestCarriesNothing) {
  const BarrierResponse r = Built{}.look();
  for (const Component c : all_components) {
    EXPECT_EQ(r[c].force_sum, 0) << name(c);
    EXPECT_EQ(r[c].max_tension, 0) << name(c);
    EXPECT_EQ(r[c].energy.elastic(), 0) << name(c);
    EXPECT_EQ(r[c].broken_bonds, 0) << name(c);
  }
  EXPECT_EQ(r.elongation, 0);
  EXPECT_EQ(r.kinetic_energy, 0);
  EXPECT_EQ(r.potential_energy, 0);
  EXPECT_EQ(name(Component::lower_cable), "lower_cable");
  EXPECT_EQ(name(Component::barrier), "barrier");
}

TEST(Response, SumsBondForcesByComponent) {
  Built b;
  const std::size_t lower = b.net.cable(Side::lower)->first_bond, upper = b.net.cable(Side::upper)->first_bond;
  b.bonds.axial_force[lower + 1] = 3;
  b.bonds.shear_force.set(lower + 1, {0, 4, 0});  // magnitude 5
  b.bonds.axial_force[lower + 2] = -2;            // compression counts in the sum, not in the tension
  b.bonds.axial_force[upper + 5] = 7;
  b.bonds.axial_force[b.net.rings[3].first_bond] = 11;
  b.bonds.axial_force[b.net.rings[4].first_bond] = 100;
  b.bonds.intact[b.net.rings[4].first_bond] = 0;  // a broken bond carries nothing
  const BarrierResponse r = b.look();
  EXPECT_DOUBLE_EQ(r[Component::lower_cable].force_sum, 7);
  EXPECT_DOUBLE_EQ(r[Component::lower_cable].max_tension, 3);
  EXPECT_DOUBLE_EQ(r[Component::upper_cable].force_sum, 7);
  EXPECT_DOUBLE_EQ(r[Component::left_cable].force_sum, 0);
  EXPECT_DOUBLE_EQ(r[Component::rings].force_sum, 11);
  EXPECT_EQ(r[Component::rings].broken_bonds, 1);
  EXPECT_DOUBLE_EQ(r[Component::barrier].force_sum, 25);
  EXPECT_DOUBLE_EQ(r[Component::barrier].max_tension, 11);
}

TEST(Response, ReactionsAreForcesOnFixedBeads) {
  Built b;
  const Wire& left = *b.net.cable(Side::left);
  b.particles.force.set(left.first_bead, {1, 0, 0});
  b.particles.force.set(left.first_bead + left.beads - 1, {0, 2, 0});
  b.particles.force.set(left.first_bead + left.beads / 2, {0, 0, 3});
  b.particles.force.set(left.first_bead + 1, {50, 50, 50});  // free
  const BarrierResponse r = b.look();
  EXPECT_EQ(r[Component::left_cable].start_reaction, Vec3(1, 0, 0));
  EXPECT_EQ(r[Component::left_cable].end_reaction, Vec3(0, 2, 0));
  EXPECT_EQ(r[Component::left_cable].reaction, Vec3(1, 2, 3));
  EXPECT_EQ(r[Component::barrier].reaction, Vec3(1, 2, 3));
}

TEST(Response, EnergiesAreThoseOfTheSprings) {
  Built b;
  const std::size_t ring = b.net.rings[0].first_bond, brake = b.net.dissipators[0];
  const double radius = 0.00305, area = std::numbers::pi * radius * radius, inertia = 0.25 * area * radius * radius;
  b.bonds.elongation[ring] = 1e-5;
  b.bonds.shear_force.set(ring, {0, 0, 6});
  b.bonds.moment.set(ring, {0, 2, 0});
  b.bonds.torsion_moment[ring] = 0.5;
  const double knee = 2000 / (8e11 * area);  // m, where the dissipator gives way
  b.bonds.elongation[brake] = knee + 1e-4;
  const BarrierResponse r = b.look();
  EXPECT_NEAR(r[Component::rings].energy.axial, 0.5 * 3e11 * area * 1e-10, 1e-12);
  EXPECT_NEAR(r[Component::rings].energy.shear, 0.5 * 36 / (3e11 * area), 1e-12);
  EXPECT_NEAR(r[Component::rings].energy.bending, 0.5 * 4 / (3e11 * inertia), 1e-9);
  EXPECT_NEAR(r[Component::rings].energy.torsion, 0.5 * 0.25 / (3e11 * 2 * inertia), 1e-9);
  EXPECT_NEAR(r[Component::upper_cable].energy.axial, 1000 * knee + 0.2 + 0.5 * 8e10 * area * 1e-8, 1e-9);
  EXPECT_NEAR(r[Component::barrier].energy.elastic(),
              r[Component::rings].energy.elastic() + r[Component::upper_cable].energy.elastic(), 1e-12);
  EXPECT_DOUBLE_EQ(r.largest_dissipator_elongation, knee + 1e-4);
  EXPECT_DOUBLE_EQ(dissipator_elongation(b.net, b.bonds, 0), knee + 1e-4);
}

/// A wire that goes slack does not bend, whatever moment stands in its bond.
TEST(Response, WiresThatOnlyPullHoldNoBending) {
  Built b;
  const std::size_t ring = b.net.rings[0].first_bond;
  b.bonds.sorts[static_cast<std::size_t>(b.bonds.sort[ring])].axial.tension_only = true;
  b.bonds.moment.set(ring, {0, 2, 0});
  EXPECT_EQ(b.look()[Component::rings].energy.elastic(), 0);
}

/// What plastic elongation took stays taken when the bond breaks.
TEST(Response, BrokenBondsKeepTheirPlasticWork) {
  Built b;
  const std::size_t brake = b.net.dissipators[0];
  b.bonds.sorts[static_cast<std::size_t>(b.bonds.sort[brake])].axial.plastic_unloading = true;
  b.bonds.plastic_elongation[brake] = 1e-4;
  const double whole = b.look()[Component::upper_cable].energy.plastic;
  EXPECT_GT(whole, 0);
  b.bonds.intact[brake] = 0;
  EXPECT_EQ(b.look()[Component::upper_cable].energy.plastic, whole);
}

TEST(Response, MotionOfTheBeads) {
  Built b;
  const std::size_t bead = b.net.rings[5].first_bead;
  b.particles.position.add(bead, {0.03, 0.5, -0.2});  // flow along x
  b.particles.position.add(bead + 1, {-0.9, 0, 0});
  b.particles.velocity.set(bead, {0, 3, 0});
  b.particles.angular_velocity.set(bead, {0, 0, 100});
  const BarrierResponse r = b.look();
  const double m = b.particles.mass[bead];
  EXPECT_NEAR(r.elongation, 0.03, 1e-15);
  EXPECT_NEAR(r.kinetic_energy, 0.5 * m * 9 + 0.5 * b.particles.inertia[bead] * 1e4, 1e-15);
  EXPECT_NEAR(r.potential_energy, -m * 10 * 0.2, 1e-12);
}

}  // namespace
}  // namespace lahar::barrier
