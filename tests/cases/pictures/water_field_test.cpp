#include "cases/pictures/water_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/cases/pictures/fluid_shapes.h"

namespace lahar::cases {
namespace {

constexpr double kCell = 0.05;

double ball(const Vec3& p) { return std::clamp((0.9 - (p - Vec3(1.6, 1.6, 1.6)).norm()) / kCell + 0.5, 0.0, 1.0); }

TEST(WaterField, AVerticalRayMeasuresTheDepth) {
  // Level 0.73 m lies 0.6 of a cell above a cell's floor; the water's floor is the lower side of the blocks.
  const WaterField water(fluid_of(kCell, Vec3i(0, 0, 0), Vec3i(4, 4, 4), level_water(0.73, kCell)), 0);
  const WetSpans wet = water.wet_spans({Vec3f(0.61F, 0.87F, 3), -Vec3f::UnitZ()}, kNoHit);
  ASSERT_EQ(wet.count, 1);
  EXPECT_NEAR(wet.spans[0].entry, 3 - 0.73F, 0.1F * kCell);
  EXPECT_NEAR(wet.spans[0].exit, 3.0F, 0.02F * kCell);
  EXPECT_TRUE(water.normal(Vec3f(0.61F, 0.87F, 0.73F)).isApprox(Vec3f::UnitZ(), 1e-4F));
}

TEST(WaterField, SlantingRaysThroughABallHaveTheRightChords) {
  for (const int smoothing : {0, 1}) {
    const WaterField water(fluid_of(kCell, Vec3i(0, 0, 0), Vec3i(8, 8, 8), ball), smoothing);
    for (int n = 0; n < 50; ++n) {
      const float angle = 0.37F * static_cast<float>(n), miss = 0.015F * static_cast<float>(n);
      const Vec3f direction = Vec3f(std::cos(angle), std::sin(angle), 0.5F * std::sin(3 * angle)).normalized();
      const Vec3f side = direction.cross(Vec3f::UnitZ()).normalized();
      const WetSpans wet = water.wet_spans({Vec3f::Constant(1.6F) + miss * side - 3 * direction, direction}, kNoHit);
      const float half = std::sqrt(0.81F - miss * miss);
      ASSERT_EQ(wet.count, 1) << n;
      EXPECT_NEAR(wet.spans[0].entry, 3 - half, 0.3F * kCell) << n;
      EXPECT_NEAR(wet.spans[0].exit, 3 + half, 0.3F * kCell) << n;
      const Vec3f out = direction * -half + miss * side;
      EXPECT_GT(water.normal(Vec3f::Constant(1.6F) + out).dot(out.normalized()), smoothing == 0 ? 0.97F : 0.99F) << n;
    }
  }
}

TEST(WaterField, RaysEndAndStartInTheWater) {
  const WaterField water(fluid_of(kCell, Vec3i(0, 0, 0), Vec3i(8, 8, 8), ball), 0);
  const Ray inward{Vec3f(-1, 1.6F, 1.6F), Vec3f::UnitX()};
  const WetSpans cut = water.wet_spans(inward, 2.0F);
  ASSERT_EQ(cut.count, 1);
  EXPECT_NEAR(cut.spans[0].exit, 2.0F, 1e-4F);
  EXPECT_EQ(water.wet_spans(inward, 1.0F).count, 0);
  const WetSpans inside = water.wet_spans({Vec3f::Constant(1.6F), Vec3f::UnitY()}, kNoHit);
  ASSERT_EQ(inside.count, 1);
  EXPECT_EQ(inside.spans[0].entry, 0);
  EXPECT_NEAR(inside.spans[0].exit, 0.9F, 0.2F * kCell);
}

TEST(WaterField, TwoSheetsAreTwoSpansAlsoAtNegativeCells) {
  const auto sheets = [](const Vec3& p) {
    return std::abs(p.z() - 0.3) < 0.1 || std::abs(p.z() + 0.5) < 0.15 ? 1.0 : 0.0;
  };
  const WaterField water(fluid_of(kCell, Vec3i(-2, -2, -3), Vec3i(2, 2, 3), sheets), 0);
  const WetSpans wet = water.wet_spans({Vec3f(-0.33F, 0.41F, 2), -Vec3f::UnitZ()}, kNoHit);
  ASSERT_EQ(wet.count, 2);
  EXPECT_NEAR(wet.spans[0].entry, 1.6F, 1e-3F);
  EXPECT_NEAR(wet.spans[0].exit, 1.8F, 1e-3F);
  EXPECT_NEAR(wet.spans[1].entry, 2.35F, 1e-3F);
  EXPECT_NEAR(wet.spans[1].exit, 2.65F, 1e-3F);
}

TEST(WaterField, InterpolationIsExactForLinearFields) {
  const auto linear = [](const Vec3& p) { return 0.1 + 0.05 * p.x() + 0.1 * p.y() - 0.03 * p.z(); };
  const WaterField water(fluid_of(kCell, Vec3i(0, 0, 0), Vec3i(4, 4, 4), linear), 1);
  for (const Vec3& p : {Vec3(0.41, 0.77, 0.5), Vec3(0.8, 0.4, 1.19)})
    EXPECT_NEAR(water.fill_level(p.cast<float>()), linear(p), 1e-5);
  EXPECT_EQ(water.fill_level(Vec3f(-9, 0, 0)), 0);
}

TEST(WaterField, ADrySceneIsEmpty) {
  const WaterField water(lbm::FluidSnapshot{}, 1);
  EXPECT_TRUE(water.empty());
  EXPECT_EQ(water.wet_spans({Vec3f::Zero(), Vec3f::UnitX()}, kNoHit).count, 0);
}

}  // namespace
}  // namespace lahar::cases
