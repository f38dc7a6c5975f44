#include "barrier/retaining.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "barrier/spans.h"
#include "core/check.h"
#include "dem/time_step.h"

namespace lahar::barrier {
namespace {

/// Two spans with retaining cables.
SpansSpec spans_with(const std::vector<RetainingCable>& cables) {
  SpansSpec s;
  s.net.width = 0.2, s.net.height = 0.14;
  for (dem::BondSort* sort : {&s.net.ring, &s.net.cable, &s.net.dissipator})
    sort->bond_radius = 0.5 * s.net.wire_diameter, sort->damping_ratio = 0.02;
  s.spans = 2, s.post_height = 0.16, s.post_diameter = 0.025;
  s.section = {.youngs_modulus = 210e9, .area = 1.445e-4, .second_moment = 9.63e-9, .density = 7850};
  s.elements.of<RetainingCable>() = cables;
  return s;
}

std::string refusal_of(const SpansSpec& spec) {
  dem::Particles particles;
  dem::Bonds bonds;
  try {
    build_spans(spec, particles, bonds);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

std::string refusal(const std::vector<RetainingCable>& cables) { return refusal_of(spans_with(cables)); }

TEST(Retaining, StandsAtItsPostOrAtEvery) {
  for (const std::int64_t post : {-1, 1}) {
    dem::Particles p;
    dem::Bonds b;
    const Net net = build_spans(spans_with({{.post = post, .anchor = {-0.15, 0, 0.01}, .dissipators_at = {0}}}), p, b);
    const auto& cables = net.elements.at(0);
    ASSERT_EQ(cables.size(), post < 0 ? 3u : 1u);
    for (std::size_t k = 0; k < cables.size(); ++k) {
      const Post& own = net.posts[post < 0 ? k : static_cast<std::size_t>(post)];
      const dem::ParticleId anchor = cables[k].first_bead, end = anchor + cables[k].beads - 1;
      EXPECT_EQ(p.state[anchor], dem::ParticleState::fixed);
      const Vec3 base(net.start[own.wire.first_bead - net.first_bead]);
      EXPECT_LT((Vec3(p.position[anchor]) - base - Vec3(-0.15, 0, 0.01)).norm(), 1e-12);
      // The last bead touches the post, but for a twentieth of its diameter, and so does what leads down from there.
      const Vec3 head = p.position[own.head()], foot = p.position[own.wire.first_bead],
                 axis = (head - foot).normalized();
      const Vec3 arm = Vec3(p.position[end]) - head;
      EXPECT_NEAR((arm - arm.dot(axis) * axis).norm() - own.radius, 0.55 * net.wire_diameter, 1e-12);
    }
  }
}

TEST(Retaining, KnowsItsBeadsAndItsTimeStepBeforeItIsBuilt) {
  const RetainingCable cable{.post = -1, .anchor = {-0.15, 0, 0}, .dissipators_at = {0}};
  const SpansSpec spec = spans_with({cable});
  dem::Particles p, alone;
  dem::Bonds b, wire;
  const Net net = build_spans(spec, p, b);
  double beads = 0;
  for (const Wire& w : net.elements.at(0)) beads += w.beads;
  EXPECT_NEAR(cable.beads(spec) / beads, 1, 0.05);
  // Two beads of its wire: no bead is taken as held less than in the middle of a chain.
  const int sort = wire.add_sort(spec.net.cable);
  for (const double x : {0.0, spec.net.wire_diameter})
    alone.add({.position = {x, 0, 0}, .radius = 0.5 * spec.net.wire_diameter, .density = spec.net.density});
  wire.add({0, 1, sort}, alone);
  EXPECT_NEAR(cable.bond_limit(spec) / dem::bond_time_step(wire, alone), 1, 1e-12);
  const RetainingCable plain{.post = -1, .anchor = {-0.15, 0, 0}, .dissipators_at = {}};
  EXPECT_LE(cable.bond_limit(spec), plain.bond_limit(spec));
}

TEST(Retaining, RefusesWhatCannotStand) {
  const auto contains = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_EQ(refusal({{.post = -1, .anchor = {-0.15, 0, 0}}}), "");
  EXPECT_TRUE(contains(refusal({{.post = -1, .anchor = {-0.01, 0, 0}}}), "lies at its post"));
  EXPECT_TRUE(contains(refusal({{.post = -1, .anchor = {0, 0.12, 0}}}), "runs through the net"));
  // A thin post: its cable's last bead, 3.1 + 0.55 x 6.1 mm from the axis, would be 16 mm beyond an anchor at 6.25 mm.
  SpansSpec steep = spans_with({{.post = -1, .anchor = {-0.00625, 0, 0.1}}});
  steep.post_height = 0.6, steep.post_diameter = 0.0062;
  EXPECT_TRUE(contains(refusal_of(steep), "no cable fits")) << refusal_of(steep);
  EXPECT_TRUE(contains(refusal({{.post = 1, .anchor = {-0.15, 0, 0}, .dissipators_at = {0, 0.001}}}), "fall on one"));
  EXPECT_TRUE(contains(refusal({{.post = 3, .anchor = {-0.15, 0, 0}}}), "post 3"));
  // Two to one place run into each other; from one head to two places they part.
  const RetainingCable one{.post = 1, .anchor = {-0.15, 0, 0}}, beside{.post = 1, .anchor = {-0.15, 0.1, 0}};
  EXPECT_TRUE(contains(refusal({one, {.post = 1, .anchor = {-0.15, 0.005, 0}}}), "runs into another one"));
  EXPECT_EQ(refusal({one, beside}), "");
}

}  // namespace
}  // namespace lahar::barrier
