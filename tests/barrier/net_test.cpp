#include "barrier/net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "barrier/clearance.h"
#include "core/check.h"
#include "dem/time_step.h"

namespace lahar::barrier {
namespace {

struct Built {
  dem::Particles particles;
  dem::Bonds bonds;
  Net net;
  explicit Built(const RingNetSpec& spec) { net = build_net(spec, particles, bonds); }
};

const Built& paper_net() {
  static const Built built{RingNetSpec{}};
  return built;
}

RingNetSpec small_spec() {
  RingNetSpec spec;
  spec.width = 0.24, spec.height = 0.18;
  spec.fit = NetFit::cables_on_frame;
  return spec;
}

/// The rockfall net: 13 x 13 rings of 0.3 m with 60 touching beads.
RingNetSpec rockfall_spec() {
  RingNetSpec spec;
  spec.ring_diameter = 0.3, spec.ring_pitch = 0.2766, spec.beads_per_ring = 60, spec.wire_diameter = 0.0157;
  spec.width = spec.height = 13 * spec.ring_pitch;
  spec.fit = NetFit::cables_on_frame;
  return spec;
}

TEST(Net, PaperNetHasItsRingsBeadsAndMass) {
  const auto& [particles, bonds, net] = paper_net();
  EXPECT_EQ(net.columns, 30);
  EXPECT_EQ(net.rows, 16);
  EXPECT_EQ(net.rings.size(), 480u);
  std::size_t beads = 0;
  for (const Wire& ring : net.rings) beads += ring.beads;
  EXPECT_EQ(beads, 17280u);
  EXPECT_NEAR(net.cable(Side::upper)->beads, 295, 2);
  EXPECT_NEAR(net.cable(Side::left)->beads, 155, 4);
  EXPECT_EQ(net.beads, particles.size());
  const double mass = std::accumulate(particles.mass.begin(), particles.mass.end(), 0.0);
  EXPECT_NEAR(mass, static_cast<double>(net.beads) * std::numbers::pi / 6 * std::pow(0.0061, 3) * 7800, 1e-9);
  EXPECT_NEAR(mass, 17, 0.3);
}

/// Of a chain with equal stiffness against tension and shear the spins limit the step, up to a moment of inertia of m
/// r^2.
TEST(Net, BeadsMayHaveAMomentOfInertiaOfTheirOwn) {
  RingNetSpec spec = small_spec();
  const double light = spec.bond_limit(spec.ring);
  spec.bead_inertia_scale = 2.5;
  EXPECT_NEAR(spec.bond_limit(spec.ring) / light, std::sqrt(2.5), 1e-12);
  const Built built(spec);
  const double r = 0.5 * spec.wire_diameter, mass = spec.bead_properties().bead_mass();
  for (std::size_t i = 0; i < built.particles.size(); ++i) EXPECT_NEAR(built.particles.inertia[i], mass * r * r, 1e-18);
  EXPECT_NEAR(dem::bond_time_step(built.bonds, built.particles) / spec.bond_limit(spec.cable), 1, 0.02);
  spec.bead_inertia_scale = 5;
  EXPECT_NEAR(spec.bond_limit(spec.ring) / light, std::sqrt(2.5), 1e-12);
}

TEST(Net, SlowBeadsWeighWhatTheyWeighed) {
  RingNetSpec spec = small_spec();
  const Built built(spec);
  spec.bead_mass_scale = 4;
  const Built slow(spec);
  for (std::size_t i = 0; i < slow.particles.size(); ++i) {
    EXPECT_EQ(slow.particles.gravitational_mass[i], built.particles.mass[i]);
    EXPECT_NEAR(slow.particles.mass[i] / built.particles.mass[i], 4, 1e-14);
  }
}

TEST(Net, PaperNetIsHeldWhereThePaperHoldsIt) {
  const auto& [particles, bonds, net] = paper_net();
  std::vector<dem::ParticleIndex> expected;
  const Wire& lower = *net.cable(Side::lower);
  for (std::uint32_t k = 0; k < lower.beads; ++k) expected.push_back(lower.first_bead + k);
  for (const Side side : {Side::upper, Side::left, Side::right}) {
    const Wire& cable = *net.cable(side);
    expected.push_back(cable.first_bead);
    if (side != Side::upper) expected.push_back(cable.first_bead + cable.beads / 2);
    expected.push_back(cable.first_bead + cable.beads - 1);
  }
  EXPECT_EQ(net.fixed_beads, expected);
  ASSERT_EQ(net.dissipators.size(), 6u);
  for (const std::size_t b : net.dissipators) {  // each next to an anchor
    EXPECT_NE(particles.state[bonds.i[b]] == dem::ParticleState::fixed,
              particles.state[bonds.j[b]] == dem::ParticleState::fixed);
    EXPECT_EQ(bonds.sorts[static_cast<std::size_t>(bonds.sort[b])].axial.force_limit[0], 2000);
  }
  for (const dem::BondSort& sort : bonds.sorts) EXPECT_DOUBLE_EQ(sort.bond_radius, 0.00305);
}

TEST(Net, WiresDoNotOverlapAndBondsAreEqual) {
  for (const RingNetSpec& spec : {RingNetSpec{}, rockfall_spec(), small_spec()}) {
    const Built built(spec);
    const double d = spec.wire_diameter;
    const std::vector<Polyline> lines = centre_lines(built.net, built.particles);
    EXPECT_GE(smallest_wire_gap(lines, d), 0.005 * d);
    const double spacing = bead_spacing({spec.ring_diameter, spec.beads_per_ring});
    for (const Wire& ring : built.net.rings)
      for (std::size_t b = ring.first_bond; b < ring.first_bond + ring.bonds; ++b)
        ASSERT_NEAR(built.bonds.rest_length[b] / spacing, 1, 0.005);
  }
}

TEST(Net, FitInsideStaysInsideTheFrame) {
  RingNetSpec rockfall = rockfall_spec();
  rockfall.width = rockfall.height = 3.9;
  rockfall.fit = NetFit::inside;
  for (const RingNetSpec& spec : {RingNetSpec{}, rockfall}) {
    const Built built(spec);
    double least = 1;
    for (std::size_t i = 0; i < built.particles.size(); ++i) {
      const double y = built.particles.position.y[i], z = built.particles.position.z[i], r = 0.5 * spec.wire_diameter;
      least = std::min({least, y - r, spec.width - y - r, z - r, spec.height - z - r});
    }
    EXPECT_GT(least, 0);
    EXPECT_LT(least, spec.wire_diameter);  // and fills it
  }
}

TEST(Net, RockfallNetHasThirteenByThirteenRings) {
  const Built built(rockfall_spec());
  EXPECT_EQ(built.net.rings.size(), 169u);
  EXPECT_EQ(built.net.cables.size(), 4u);
  EXPECT_DOUBLE_EQ(built.net.pitch_across, 0.2766);
}

TEST(Net, BodiesAreRingsThenCablesAndBeadsAreContiguous) {
  dem::Particles particles;
  dem::Bonds bonds;
  particles.add({.radius = 0.1, .density = 1});  // a grain before the net
  RingNetSpec spec = small_spec();
  spec.first_body = 7;
  const Net net = build_net(spec, particles, bonds);
  EXPECT_EQ(net.first_bead, 1u);
  EXPECT_EQ(net.first_bead + net.beads, particles.size());
  std::int32_t body = 7;
  for (const auto* wires : {&net.rings, &net.cables})
    for (const Wire& wire : *wires) {
      for (std::uint32_t k = 0; k < wire.beads; ++k) ASSERT_EQ(particles.body[wire.first_bead + k], body);
      ++body;
    }
  EXPECT_EQ(body, 7 + 12 + 4);
}

TEST(Net, StandsInAnyFrame) {
  RingNetSpec spec = small_spec();
  const Built plain(spec);
  spec.origin = {1, 2, 3};
  spec.across = Vec3::UnitX();
  spec.up = Vec3(0, 0.6, 0.8);
  spec.normal = Vec3(0, -0.8, 0.6);
  const Built turned(spec);
  ASSERT_EQ(plain.particles.size(), turned.particles.size());
  for (std::size_t i = 0; i < plain.particles.size(); ++i) {
    const Vec3 p = plain.particles.position[i];
    EXPECT_LT((spec.origin + p.y() * spec.across + p.z() * spec.up + p.x() * spec.normal - turned.particles.position[i])
                  .norm(),
              1e-12);
  }
}

TEST(Net, FreeNetHasNothingButRings) {
  RingNetSpec spec = small_spec();
  spec.free_net = true;
  const Built built(spec);
  EXPECT_TRUE(built.net.cables.empty());
  EXPECT_TRUE(built.net.fixed_beads.empty());
  EXPECT_TRUE(built.net.dissipators.empty());
  EXPECT_EQ(built.net.cable(Side::lower), nullptr);
  EXPECT_EQ(built.net.beads, 12u * 36u);
}

TEST(Net, CablesCanBeLeftOut) {
  RingNetSpec spec = small_spec();
  spec.left.present = spec.right.present = false;
  const Built built(spec);
  EXPECT_EQ(built.net.cables.size(), 2u);
  EXPECT_EQ(built.net.dissipators.size(), 2u);
  EXPECT_EQ(built.net.cable(Side::left), nullptr);
}

TEST(Net, NamesSizesThatWholeRingsFill) {
  RingNetSpec spec = small_spec();
  spec.fit = NetFit::inside;
  spec.free_net = true;
  dem::Particles particles;
  dem::Bonds bonds;
  try {
    build_net(spec, particles, bonds);
    FAIL() << "0.24 m were accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("0.19976 m and 0.25976 m would do"), std::string::npos) << e.what();
  }
  spec.width = 0.25976, spec.height = 0.19976;
  EXPECT_EQ(build_net(spec, particles, bonds).rings.size(), 12u);
}

std::string mistake_of(const RingNetSpec& spec) {
  dem::Particles particles;
  dem::Bonds bonds;
  try {
    build_net(spec, particles, bonds);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

TEST(Net, NumbersInMistakesArePlain) {
  RingNetSpec spec = small_spec();
  spec.ring_pitch = 1e-18;
  std::string text = mistake_of(spec);
  EXPECT_NE(text.find("rings at a pitch of 1e-18 m lie in each other, expected more than the wire, 0.0061 m"),
            std::string::npos)
      << text;
  spec = small_spec();
  spec.wire_diameter = 0.03;
  text = mistake_of(spec);
  EXPECT_NE(text.find("a ring of 0.07 m is too narrow for its wire, expected more than three wires, 0.09 m"),
            std::string::npos)
      << text;
}

/// Of a wire so thin that one ring more makes no difference to see.
TEST(Net, ASizeThatWouldDoIsNamedOnce) {
  RingNetSpec spec = small_spec();
  spec.free_net = true;
  spec.fit = NetFit::inside;
  spec.wire_diameter = 1e-8, spec.ring_pitch = 1.5e-8, spec.beads_per_ring = 22'000'000;
  spec.width = spec.height = 0.05;
  const std::string text = mistake_of(spec);
  EXPECT_NE(text.find("at a pitch of 1.5e-08 m do not fill a width of 0.05 m; 0.07 m would do"), std::string::npos)
      << text;
}

TEST(Net, RefusesWhatCannotBeBuilt) {
  const auto refused = [](auto change) {
    RingNetSpec spec = small_spec();
    change(spec);
    dem::Particles particles;
    dem::Bonds bonds;
    EXPECT_THROW(build_net(spec, particles, bonds), InputError);
    EXPECT_EQ(particles.size(), 0u);
  };
  refused([](RingNetSpec& s) { s.ring_pitch = 0.08; });     // rings apart
  refused([](RingNetSpec& s) { s.ring_pitch = 0.03; });     // second neighbours in the way
  refused([](RingNetSpec& s) { s.beads_per_ring = 25; });   // 1.438 diameters: rings pass through each other
  refused([](RingNetSpec& s) { s.beads_per_ring = 60; });   // beads overlap
  refused([](RingNetSpec& s) { s.wire_diameter = 0.03; });  // no room in the ring
  refused([](RingNetSpec& s) { s.fit = NetFit::inside; });  // 4 x 3 rings would need a much smaller pitch
  refused([](RingNetSpec& s) { s.wire_diameter = 0; });
  refused([](RingNetSpec& s) { s.density = -1; });
  refused([](RingNetSpec& s) { s.width = 0.01; });
  refused([](RingNetSpec& s) { s.up = Vec3(0, 0.1, 1); });
  refused([](RingNetSpec& s) { s.normal = Vec3(2, 0, 0); });
}

}  // namespace
}  // namespace lahar::barrier
