#include "dem/packing/packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/check.h"
#include "core/parallel.h"
#include "dem/packing/grading.h"

namespace lahar::dem {
namespace {

/// A few hundred spheres of the paper's two sizes, 1 : 2, by the paper's share.
PackingSpec two_sizes() {
  PackingSpec s;
  s.lower = {1, -2, 3};
  s.upper = {1.4, -1.6, 3.6};
  s.classes = {{0.02, 344, 2500, 1}, {0.04, 156, 2700, 2}};
  s.seed = 7;
  return s;
}

TEST(Packing, HasTheSpheresAskedForInsideTheBox) {
  const PackingSpec spec = two_sizes();
  const auto spheres = pack(spec);
  ASSERT_EQ(spheres.size(), 500u);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const ParticleSpec& s = spheres[i];
    const SizeClass& c = spec.classes[i < 344 ? 0 : 1];
    EXPECT_EQ(s.radius, c.radius);
    EXPECT_EQ(s.density, c.density);
    EXPECT_EQ(s.material, c.material);
    EXPECT_TRUE(s.velocity.isZero());
    EXPECT_TRUE((s.position.array() - s.radius >= spec.lower.array() - 1e-12).all());
    EXPECT_TRUE((s.position.array() + s.radius <= spec.upper.array() + 1e-12).all());
  }
}

/// Largest overlap over the smaller radius, by comparing all pairs, not by the packing's own lists.
double worst_overlap(const std::vector<ParticleSpec>& spheres) {
  double worst = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double reach = spheres[i].radius + spheres[j].radius;
      const double overlap = reach - (spheres[i].position - spheres[j].position).norm();
      worst = std::max(worst, overlap / std::min(spheres[i].radius, spheres[j].radius));
    }
  return worst;
}

TEST(Packing, IsDenseAndFreeOfOverlaps) {
  const PackingSpec spec = two_sizes();
  const auto spheres = pack(spec);
  const double worst = worst_overlap(spheres);
  EXPECT_LT(worst, 1e-3);
  const PackingReport report = measure_packing(spec, spheres);
  EXPECT_NEAR(report.max_relative_overlap, worst, 1e-12);
  EXPECT_GT(report.solid_fraction, 0.60);
  EXPECT_LT(report.solid_fraction, 0.70);
  EXPECT_GT(report.height, report.surface_height);
}

TEST(Packing, EqualSpheresComeNearRandomClosePacking) {
  PackingSpec spec;
  spec.upper = {0.4, 0.4, 0.8};
  spec.classes = {{0.02, 1000, 2500, 0}};
  const PackingReport report = measure_packing(spec, pack(spec));
  EXPECT_GT(report.solid_fraction, 0.60);
  EXPECT_LT(report.solid_fraction, 0.66);
  EXPECT_LT(report.max_relative_overlap, 1e-3);
}

/// 4 : 1 in diameter: enough that the near lists take their other way. Every pair is compared.
TEST(Packing, SieveCurveIsDenseAndFreeOfOverlaps) {
  PackingSpec spec;
  spec.upper = {0.2, 0.2, 0.35};
  spec.target_height = 0.13;
  const double volume = 0.64 * 0.2 * 0.2 * spec.target_height;
  for (const double d : draw_diameters({{0.01, 0}, {0.02, 0.3}, {0.04, 1}}, volume, 3))
    spec.classes.push_back({d / 2, 1, 2650, 0});
  const auto spheres = pack(spec);
  ASSERT_EQ(spheres.size(), spec.classes.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) EXPECT_EQ(spheres[i].radius, spec.classes[i].radius);
  const double worst = worst_overlap(spheres);
  EXPECT_LT(worst, 1e-3);
  const PackingReport report = measure_packing(spec, spheres);
  EXPECT_NEAR(report.max_relative_overlap, worst, 1e-12);
  EXPECT_GE(report.solid_fraction, 0.63);
  EXPECT_LT(report.solid_fraction, 0.72);
}

TEST(Packing, MeasuresASingleLayerExactly) {
  PackingSpec spec;
  spec.upper = {0.4, 0.4, 0.4};
  std::vector<ParticleSpec> layer;  // 10 x 10 touching spheres of diameter 0.04 m on the floor
  for (int k = 0; k < 100; ++k) {
    ParticleSpec s;
    s.radius = 0.02, s.density = 1000;
    s.position = {0.02 + 0.04 * (k % 10), 0.02 + 0.04 * (k / 10), 0.02};
    layer.push_back(s);
  }
  const PackingReport report = measure_packing(spec, layer);
  EXPECT_DOUBLE_EQ(report.height, 0.04);
  // Mean over a square of side 2 r: the disc pi / 4 at the height r of the centre, and on it a half sphere.
  EXPECT_NEAR(report.surface_height, 0.02 * (std::numbers::pi / 4 + std::numbers::pi / 6), 5e-3 * 0.02);
  EXPECT_NEAR(report.max_relative_overlap, 0, 1e-12);
}

/// A few grains among boulders: lines a twentieth of their radius apart would be 6e9. A sphere of radius R on a floor
/// of the area A adds 5/3 pi R^3 / A to the mean height.
TEST(Packing, MeasuresWideFloorsWithSmallGrains) {
  PackingSpec spec;
  spec.upper = {4, 4, 1};
  std::vector<ParticleSpec> spheres;
  for (const auto& [x, r] : {std::pair{2.0, 0.2}, {0.5, 0.001}, {3.5, 0.001}}) {
    ParticleSpec s;
    s.radius = r, s.density = 1000;
    s.position = {x, 2, r};
    spheres.push_back(s);
  }
  const double expected = 5.0 / 3 * M_PI * 0.2 * 0.2 * 0.2 / 16;
  EXPECT_NEAR(measure_packing(spec, spheres).surface_height, expected, 1e-3 * expected);
}

TEST(Packing, IsFixedByItsSeedWhateverTheThreads) {
  PackingSpec spec = two_sizes();
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return pack(spec);
  };
  const auto one = run(1), two = run(2);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].position, two[i].position);
  spec.seed = 8;
  EXPECT_NE(run(2)[0].position, one[0].position);
}

TEST(Packing, TappingLowersTheSurface) {
  PackingSpec spec = two_sizes();
  const double loose = measure_packing(spec, pack(spec)).surface_height;
  spec.target_height = 0.995 * loose;
  EXPECT_LE(measure_packing(spec, pack(spec)).surface_height, spec.target_height);
}

TEST(Packing, OneSphereLiesOnTheFloor) {
  PackingSpec spec = two_sizes();
  spec.classes = {{0.03, 1, 2500, 0}};
  const auto spheres = pack(spec);
  ASSERT_EQ(spheres.size(), 1u);
  EXPECT_NEAR(spheres[0].position.z(), spec.lower.z() + 0.03, 1e-3 * 0.03);
  spec.classes[0].count = 0;
  EXPECT_TRUE(pack(spec).empty());
}

/// More than lie side by side on the floor, but no more than two layers: some must come to lie on others.
TEST(Packing, FewSpheresHaveRoomAboveEachOther) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    PackingSpec spec;
    spec.upper = {0.26, 0.36, 0.4};
    spec.classes = {{0.05, 8, 2600, 0}};
    spec.seed = seed;
    EXPECT_LT(worst_overlap(pack(spec)), 1e-3) << seed;
  }
}

/// Narrow boxes of spheres of a third of their width, which jam: what is accepted is as free of overlaps as promised.
TEST(Packing, SpheresThatJamAreTappedLoose) {
  int accepted = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    PackingSpec s;
    s.upper = {0.13, 0.13, 0.9};
    s.classes = {{0.04, 10, 2500, 0}};
    s.seed = seed;
    try {
      EXPECT_LT(measure_packing(s, pack(s)).max_relative_overlap, 1.01e-3) << seed;
      ++accepted;
    } catch (const InputError&) {
    }
  }
  RecordProperty("accepted", accepted);
  EXPECT_GE(accepted, 8);  // without harder taps 4
}

TEST(Packing, RefusesWhatCannotBe) {
  const auto refused = [](const auto& spoil) {
    PackingSpec spec = two_sizes();
    spoil(spec);
    EXPECT_THROW((void)pack(spec), InputError);
  };
  refused([](PackingSpec& s) { s.upper.z() = s.lower.z() + 0.2; });   // more volume than the box has
  refused([](PackingSpec& s) { s.upper.z() = s.lower.z() + 0.5; });   // fits by volume, stands higher than the box
  refused([](PackingSpec& s) { s.upper.x() = s.lower.x() + 0.07; });  // narrower than a sphere
  refused([](PackingSpec& s) { s.upper.y() = s.lower.y(); });
  refused([](PackingSpec& s) { s.classes[0].radius = 0; });
  refused([](PackingSpec& s) { s.classes[1].count = -1; });
  refused([](PackingSpec& s) { s.classes[1].density = 0; });
}

}  // namespace
}  // namespace lahar::dem
