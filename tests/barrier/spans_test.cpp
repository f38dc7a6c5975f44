#include "barrier/spans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "barrier/clearance.h"
#include "barrier/response.h"
#include "barrier/threading.h"
#include "barrier/topology.h"
#include "core/check.h"
#include "dem/solids.h"
#include "dem/time_step.h"

namespace lahar::barrier {
namespace {

SpansSpec two_spans() {
  SpansSpec s;
  s.net.width = 0.2, s.net.height = 0.14;
  for (dem::BondSort* sort : {&s.net.ring, &s.net.cable, &s.net.dissipator}) sort->damping_ratio = 0.02;
  s.net.lower = NetCable{};
  s.spans = 2, s.post_height = 0.16, s.post_diameter = 0.025;
  s.section = {.youngs_modulus = 210e9, .area = 1.445e-4, .second_moment = 9.63e-9, .density = 7850};
  s.foot = FootJoint::hinged;
  s.elements.of<RetainingCable>() = {{.post = -1, .anchor = {-0.15, 0, 0}, .dissipators_at = {0}}};
  return s;
}

struct Built {
  dem::Particles particles;
  dem::Bonds bonds;
  Net net;
  explicit Built(const SpansSpec& spec) { net = build_spans(spec, particles, bonds); }
};

std::string refusal(const SpansSpec& spec) {
  try {
    const Built built(spec);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Spans, HasItsParts) {
  const Built b(two_spans());
  EXPECT_EQ(b.net.spans, 2);
  EXPECT_EQ(b.net.rings.size(), 12u);
  EXPECT_EQ(b.net.cables.size(), 8u);
  ASSERT_EQ(b.net.posts.size(), 3u);
  ASSERT_EQ(b.net.elements.size(), Elements::components.size());
  ASSERT_EQ(b.net.elements[0].size(), 3u);
  // Each span: two ends of two cables, three places of either lateral one; and one at each retaining cable.
  EXPECT_EQ(b.net.ties.size(), 2u * (4 + 6) + 3);
  EXPECT_EQ(b.net.fixed_beads.size(), 3u * 3 + 3);  // joints and anchors
  EXPECT_TRUE(std::ranges::is_sorted(b.net.fixed_beads));
  SpansSpec twice = two_spans();  // the same place
  twice.net.left.support.fixed_at = twice.net.right.support.fixed_at = {0, 0.5, 0.5, 1};
  EXPECT_EQ(Built(twice).net.ties.size(), b.net.ties.size());
  EXPECT_EQ(b.net.first_bead + b.net.beads, b.particles.size());
  EXPECT_EQ(b.net.dissipators.size(), 2u * 8 + 3);
  const double apart = b.particles.position.y[b.net.posts[1].head()] - b.particles.position.y[b.net.posts[0].head()];
  EXPECT_NEAR(apart, 0.2 + 0.025 + 2 * 0.0061, 1e-12);
  EXPECT_NEAR(b.particles.position.z[b.net.posts[1].head()] + 0.0125, 0.16, 1e-12);
  std::vector<std::int32_t> bodies;
  for (const auto* wires : {&b.net.rings, &b.net.cables, &b.net.elements[0]})
    for (const Wire& w : *wires) bodies.push_back(w.body);
  for (const Post& p : b.net.posts) bodies.push_back(p.wire.body);
  std::ranges::sort(bodies);
  EXPECT_EQ(std::ranges::adjacent_find(bodies), bodies.end());
}

/// A foot stands in the bed, whatever the post leans: the bed does not push it out.
TEST(Spans, TheBedLeavesTheFeetOfLeaningPostsAlone) {
  for (const double lean : {0.0, 15.0}) {
    SpansSpec spec = two_spans();
    const double angle = lean * std::numbers::pi / 180;
    spec.net.up = Vec3(std::sin(angle), 0, std::cos(angle)),
    spec.net.normal = Vec3(std::cos(angle), 0, -std::sin(angle));
    spec.net.origin.z() = 0.01;
    Built b(spec);
    double weight = 0;
    for (const double mass : b.particles.gravitational_mass) weight += 9.81 * mass;
    Walls walls;
    walls.add({"bed", HalfSpace{Vec3(0, 0, 0.01), Vec3::UnitZ()}});
    dem::Materials materials;
    materials.add({"steel", 1e10, 0.3});
    dem::SolidsOptions options;
    options.time_step =
        0.3 * std::min(dem::bond_time_step(b.bonds, b.particles), dem::rayleigh_time_step(b.particles, materials));
    dem::Solids solids(b.particles, b.bonds, materials, walls, options);
    for (int s = 0; s < 2000; ++s) {
      solids.advance(1);
      for (const Post& post : b.net.posts)
        ASSERT_LT(foot_reaction(post, solids.particles()).norm(), 3 * weight) << lean << ", step " << s;
    }
  }
}

/// A clamped post bears the moment of a load about the line that it stands on.
TEST(Spans, FeetStandOnTheLowerEdge) {
  const Built b(two_spans());
  for (int k = 0; k <= 2; ++k) EXPECT_LT((post_spec(two_spans(), k).foot - post_base(two_spans(), k)).norm(), 1e-15);
  EXPECT_NEAR(b.particles.position.z[b.net.posts[1].wire.first_bead], 0, 1e-15);
}

TEST(Spans, NothingTouchesAtTheStart) {
  const Built b(two_spans());
  EXPECT_GT(smallest_wire_gap(centre_lines(b.net, b.particles), b.net.wire_diameter), 0);
  double least = 1;
  for (const Post& post : b.net.posts)
    for (dem::ParticleIndex i = post.wire.first_bead; i <= post.head(); ++i)
      for (dem::ParticleIndex j = 0; j < b.particles.size(); ++j)
        if (b.particles.body[j] != post.wire.body)
          least = std::min(
              least, (b.particles.position[i] - b.particles.position[j]).norm() - post.radius - b.particles.radius[j]);
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 0.0061);
}

TEST(Spans, LinksStayWithinASpan) {
  const Built b(two_spans());
  const Topology t = find_topology(b.net, b.particles, b.bonds);
  for (std::size_t r = 0; r < b.net.rings.size(); ++r)
    for (const Link& l : t.links[r]) {
      const auto other = static_cast<std::size_t>(l.other);
      EXPECT_EQ(other < 12 ? b.net.span_of_ring(other) : b.net.span_of_cable(other - 12), b.net.span_of_ring(r));
      EXPECT_EQ(std::abs(l.number), 1);
    }
  EXPECT_EQ(threadings(b.net).size(), 2u * (3 + 3 + 2 + 2));
  for (const Threading& th : threadings(b.net))
    EXPECT_TRUE(
        place_on_cable(centre_line(b.net.rings[th.ring], b.particles), centre_line(b.net.cables[th.cable], b.particles))
            .has_value());
}

TEST(Spans, RestsFreeOfStressAndReportsEveryBond) {
  Built b(two_spans());
  dem::Materials materials;
  materials.add({"steel", 1e9, 0.3});
  materials.set_pair(0, 0, 0.1, 0.5);
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 0.3 * dem::bond_time_step(b.bonds, b.particles);
  dem::Solids solids(b.particles, b.bonds, materials, {}, options);
  solids.advance(50);
  EXPECT_LT(response(b.net, solids.particles(), solids.bonds(), Vec3::Zero())[Component::barrier].force_sum, 1e-5);
  // Then pushed at the middle post's head: all energy of the ledger is in the components.
  for (int k = 0; k < 20; ++k) {
    solids.particles().external_force.set(b.net.posts[1].head(), {300, 0, 0});
    solids.advance(50);
  }
  const BarrierResponse r = response(b.net, solids.particles(), solids.bonds(), Vec3::Zero());
  EXPECT_GT(r[component_of_kind(0)].max_tension, 1);
  EXPECT_GT(r[Component::posts].energy.elastic(), 0);
  EXPECT_NEAR(r[Component::barrier].energy.elastic() / solids.bond_energy().elastic(), 1, 1e-9);
  EXPECT_TRUE(is_reported(Component::posts, b.net));
  EXPECT_FALSE(is_reported(Component::mesh, b.net));
}

/// An end hangs on its post. A place whose nearest bead is that of the end would fix it in space as well.
TEST(Spans, RefusesPlacesBesideTheEndsOfCables) {
  const auto upper_at = [](double place) {
    SpansSpec spec = two_spans();
    spec.net.upper.support.fixed_at = {0, place, 1};
    return spec;
  };
  for (const double place : {0.001, 0.02, 0.98, 0.999, 1 - 1e-12})
    EXPECT_NE(refusal(upper_at(place)).find("from its end, which hangs on a post"), std::string::npos) << place;
  SpansSpec lower = two_spans();
  lower.net.lower.support.fixed_at = {0, 0.999, 1};
  EXPECT_NE(refusal(lower).find("from its end, which hangs on a post"), std::string::npos);
  const std::size_t without = Built(two_spans()).net.fixed_beads.size();
  for (const double place : {0.04, 0.5}) {
    const Built b(upper_at(place));
    EXPECT_EQ(b.net.fixed_beads.size(), without + 2) << place;
    for (std::size_t c = 0; c < b.net.cables.size(); ++c) {
      const Wire& cable = b.net.cables[c];
      for (const dem::ParticleId end : {cable.first_bead, cable.first_bead + cable.beads - 1})
        EXPECT_EQ(b.particles.state[b.particles.index(end)], dem::ParticleState::free) << place << ", cable " << c;
    }
  }
}

TEST(Spans, RefusesWhatCannotStand) {
  SpansSpec low = two_spans();
  low.post_height = 0.13;
  EXPECT_NE(refusal(low).find("shorter than the net"), std::string::npos);
  SpansSpec none = two_spans();
  none.spans = 0;
  EXPECT_NE(refusal(none).find("one span"), std::string::npos);
}

}  // namespace
}  // namespace lahar::barrier
