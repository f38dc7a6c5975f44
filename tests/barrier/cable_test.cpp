#include "barrier/cable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "barrier/anchors.h"
#include "barrier/dissipator.h"
#include "core/check.h"

namespace lahar::barrier {
namespace {

TEST(Cable, StraightCableFillsItsSpanWithTouchingBeads) {
  const Polyline line = cable_line({.start = {0, 0, 1}, .end = {0, 1.8, 1}}, 0.0061);
  ASSERT_EQ(line.points.size(), 296u);  // 1.8 / 0.0061 = 295.08 bonds
  EXPECT_LT((line.points.back() - Vec3(0, 1.8, 1)).norm(), 1e-12);
  for (std::size_t s = 0; s < line.segments(); ++s) EXPECT_NEAR((line.end(s) - line.start(s)).norm(), 1.8 / 295, 1e-9);
}

TEST(Cable, WaveHasTheArcLengthOfASineAndPassesZeroAtItsOrigin) {
  const double k = 2 * std::numbers::pi / 0.06, amplitude = 0.003;
  const CableShape shape{.start = {0, 0, 0},
                         .end = {0.6, 0, 0},
                         .wave_direction = Vec3::UnitY(),
                         .wave_length = 0.06,
                         .amplitude = amplitude,
                         .wave_origin = 0.015};
  const Polyline line = cable_line(shape, 0.0061);
  double arc = 0;  // of sqrt(1 + (A k cos k x)^2) by the midpoint rule
  for (int i = 0; i < 6000; ++i) arc += 1e-4 * std::hypot(1, amplitude * k * std::cos(k * 1e-4 * (i + 0.5)));
  EXPECT_NEAR(length(line), arc, 0.005 * arc);  // chords are a little shorter
  EXPECT_GE((line.end(0) - line.start(0)).norm(), 0.0061);
  for (const Vec3& p : line.points) EXPECT_NEAR(p.y(), amplitude * std::sin(k * (p.x() - 0.015)), 1e-9);
  EXPECT_THROW((void)cable_line({.start = {0, 0, 0}, .end = {0.01, 0, 0}}, 0.0061), InputError);
}

TEST(Cable, PlacesAnchorsAndDissipatorsByFractionOfLength) {
  EXPECT_EQ(items_at({0, 0.5, 1}, 11), (std::vector<std::size_t>{0, 5, 10}));
  EXPECT_THROW((void)items_at({1.5}, 11), InputError);
  dem::Particles particles;
  dem::Bonds bonds;
  const CableSorts sorts{bonds.add_sort(wire_bond(1e9, 0.003)), bonds.add_sort(dissipator_bond(1e9, 1e8, 10, 0.003))};
  const CableSupport support{.fixed_at = {0, 0.5}, .fixed_all = false, .dissipators_at = {1}};
  add_cable(cable_line({.start = {0, 0, 0}, .end = {0.1, 0, 0}}, 0.01), support, {0.01, 7800, 0}, sorts, 3, particles,
            bonds);
  ASSERT_EQ(bonds.size() + 1, particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const bool fixed = i == 0 || i == (particles.size() - 1 + 1) / 2;
    EXPECT_EQ(particles.state[i] == dem::ParticleState::fixed, fixed) << i;
    EXPECT_EQ(particles.inverse_mass[i] == 0, fixed) << i;
  }
  for (std::size_t b = 0; b < bonds.size(); ++b)
    EXPECT_EQ(bonds.sort[b], b + 1 == bonds.size() ? sorts.dissipator : sorts.wire) << b;
}

/// A cable of 30 beads has 29 bonds: 0.001 of them is the first one, 0.02 the second.
TEST(Cable, RefusesDissipatorsThatFallOnOneBond) {
  const auto brakes = [](const std::vector<double>& places) {
    dem::Particles particles;
    dem::Bonds bonds;
    const CableSorts sorts{bonds.add_sort(wire_bond(1e9, 0.003)), bonds.add_sort(dissipator_bond(1e9, 1e8, 10, 0.003))};
    const Wire cable = add_cable(cable_line({.start = {0, 0, 0}, .end = {0.295, 0, 0}}, 0.01),
                                 {.fixed_at = {0, 0, 1}, .fixed_all = false, .dissipators_at = places}, {0.01, 7800, 0},
                                 sorts, 3, particles, bonds);
    EXPECT_EQ(cable.beads, 30U);
    return std::ranges::count(bonds.sort, sorts.dissipator);
  };
  EXPECT_EQ(brakes({0, 0.02, 1}), 3);
  EXPECT_THROW((void)brakes({0, 0.001, 1}), InputError);
}

TEST(Cable, HeldAcrossItSlidesAlongItself) {
  dem::Particles particles;
  dem::Bonds bonds;
  const CableSorts sorts{bonds.add_sort(wire_bond(1e9, 0.003)), 0};
  add_cable(cable_line({.start = {0, 0, 0}, .end = {0, 0.1, 0}}, 0.01),
            {.fixed_at = {0, 1}, .fixed_all = false, .dissipators_at = {}, .held_across = true}, {0.01, 7800, 0}, sorts,
            3, particles, bonds);
  ASSERT_EQ(particles.rails.size(), particles.size() - 2);  // all but the fixed ends
  for (const dem::Rail& rail : particles.rails) {
    EXPECT_EQ(particles.state[particles.index(rail.id)], dem::ParticleState::free);
    EXPECT_NEAR((rail.along - Vec3::UnitY()).norm(), 0, 1e-12);
  }
}

TEST(Dissipator, LawsAreThoseOfTheirStages) {
  const dem::BondSort two = dissipator_bond(8e11, 8e10, 2000, 0.003);
  EXPECT_EQ(two.axial.stiffness[1], 8e10);
  EXPECT_EQ(two.axial.force_limit[0], 2000);
  EXPECT_TRUE(std::isinf(two.axial.force_limit[1]));
  const dem::BondSort three = dissipator_bond(3.7e10, 1.2e8, 1.9e9, 78e3, 98.2e3, 0.01);
  EXPECT_EQ(three.axial.stiffness[2], 1.9e9);
  EXPECT_EQ(three.axial.force_limit[1], 98.2e3);
}

}  // namespace
}  // namespace lahar::barrier
