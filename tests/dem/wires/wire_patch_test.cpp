// Overlap of smooth wires: right for what Hertz solves, the same wherever on the wire, without a step between segments.
#include "dem/wires/wire_patch.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/dem/wire_scenes.h"

namespace lahar::dem {
namespace {

constexpr double r = testing::kWireRadius;

/// Integral over all segments of a wire against a sphere or another wire.
double integral(const testing::WireScene& s, ParticleIndex from, ParticleIndex to, const WirePartner& partner,
                double reach) {
  WireChains chains;
  chains.build(s.bonds, s.particles);
  double sum = 0;
  for (ParticleIndex k = from; k < to; ++k) {
    WirePatch patch;
    const SplineSegment segment = spline_segment(chains, s.particles.position, k);
    if (find_patch(segment, partner, reach, SplineSegment::extent(chains, s.particles.position, k), {}, patch))
      sum += patch.integral;
  }
  return sum;
}

WirePartner run(const testing::WireScene& s, ParticleIndex from, ParticleIndex to) {
  WireChains chains;
  chains.build(s.bonds, s.particles);
  WirePartner partner;
  for (ParticleIndex k = from; k < to; ++k) partner.segments.push_back(spline_segment(chains, s.particles.position, k));
  return partner;
}

TEST(WirePatch, SphereOnStraightWireHasItsOverlapEverywhere) {
  constexpr double a = 0.01, overlap = 1e-5;
  testing::WireScene s;
  s.add_wire(testing::straight(9, Vec3::Zero(), Vec3(1, 2, 0.5)));
  const Vec3 along = Vec3(1, 2, 0.5).normalized(), up = along.cross(Vec3::UnitX()).normalized();
  double least = 1, most = 0;
  for (int k = 0; k < 40; ++k) {
    const Vec3 x = (0.3 * k / 40 - 0.15) * 5 * testing::kSpacing * along + (a + r - overlap) * up;
    const double e = equivalent_overlap(integral(s, 0, 9, {{x.x(), x.y(), x.z()}, {}}, a + r), a + r);
    least = std::min(least, e), most = std::max(most, e);
  }
  // The patch is taken from exact distances, the equivalent from a parabola: they differ by overlap / R.
  EXPECT_NEAR(least / overlap, 1, 2e-3);
  EXPECT_LT((most - least) / most, 1e-6);
}

TEST(WirePatch, CrossedWiresHaveTheirOverlapAtARightAngle) {
  constexpr double overlap = 1e-5;
  for (const double shift : {0.0, 0.2, 0.5, 0.77}) {
    testing::WireScene s;
    s.add_wire(testing::straight(9, Vec3::Zero(), Vec3::UnitX()));
    s.add_wire(testing::straight(9, {shift * testing::kSpacing, 0.3 * shift * testing::kSpacing, 2 * r - overlap},
                                 Vec3::UnitY()));
    const double e = equivalent_overlap(integral(s, 0, 9, run(s, 9, 18), 2 * r), 2 * r);
    EXPECT_NEAR(e / overlap, 1, 2e-3) << shift;
  }
}

TEST(WirePatch, EitherWireMayBeIntegratedAlong) {
  testing::WireScene s;
  s.add_wire(testing::straight(9, Vec3::Zero(), Vec3::UnitX()));
  s.add_wire(testing::straight(9, {0.001, 0.0005, 2 * r - 2e-5}, Vec3(1, 1, 0)));
  const double one = integral(s, 0, 9, run(s, 9, 18), 2 * r), other = integral(s, 9, 18, run(s, 0, 9), 2 * r);
  EXPECT_NEAR(one / other, 1, 1e-6);
  // At 45 degrees the patch is longer by 1 / sin 45.
  EXPECT_NEAR(equivalent_overlap(one, 2 * r) / (2e-5 * std::pow(std::sqrt(2.0), 0.4)), 1, 4e-3);
}

TEST(WirePatch, ParallelWiresPressAlongTheirWholeLength) {
  constexpr double overlap = 1e-5;
  testing::WireScene s;
  s.add_wire(testing::straight(5, Vec3::Zero(), Vec3::UnitX()));
  s.add_wire(testing::straight(9, {0.002, 0, 2 * r - overlap}, Vec3::UnitX()));
  const double expected = 4 * testing::kSpacing * overlap * overlap;
  EXPECT_NEAR(integral(s, 0, 5, run(s, 5, 14), 2 * r) / expected, 1, 1e-9);
}

TEST(WirePatch, ARingPressedFromInsideTouchesAtBothEndsOfASegment) {
  // A straight segment inside a ring of larger beads' spacing is nearest to it at both of its ends.
  testing::WireScene s;
  s.add_wire(testing::straight(2, Vec3::Zero(), Vec3::UnitX()));
  s.add_wire(testing::circle(36, 0.0344, {0, -0.0344 + 2 * r, 0}, Vec3::UnitX(), Vec3::UnitY()), true);
  WireChains chains;
  chains.build(s.bonds, s.particles);
  double sum = 0, brute = 0;
  const WirePartner partner = run(s, 2, 38);
  constexpr double reach = 2 * r + 1e-4;
  for (ParticleIndex k = 0; k < 2; ++k) {
    const SplineSegment segment = spline_segment(chains, s.particles.position, k);
    WirePatch patch;
    if (find_patch(segment, partner, reach, 0.003, {{}, 9, 0.5}, patch)) sum += patch.integral;
    constexpr int n = 20000;
    for (int m = 0; m < n; ++m) {
      const Triple x = segment.at((m + 0.5) / n);
      const double d = std::max(0.0, reach - length(x - nearest_point(partner, x, {{}, 9, 0.5}).point));
      brute += d * d * length(segment.along(0.5)) / n;
    }
  }
  EXPECT_GT(brute, 0);
  EXPECT_NEAR(sum / brute, 1, 1e-4);
}

}  // namespace
}  // namespace lahar::dem
