#include "cases/pictures/occlusion_field.h"

#include <gtest/gtest.h>

namespace lahar::cases {
namespace {

std::vector<Capsule> packed_layer() {
  std::vector<Capsule> spheres;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y)
      for (int z = 0; z < 10; ++z) {
        const Vec3f centre = 0.1F * Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        spheres.push_back({centre, centre, 0.05F});
      }
  return spheres;
}

TEST(OcclusionField, DeepInThePackIsDarkerThanItsTop) {
  const OcclusionField field(packed_layer());
  const float inside = field.openness(Vec3f(1, 1, 0.45F), Vec3f::UnitZ());
  const float top = field.openness(Vec3f(1, 1, 0.95F), Vec3f::UnitZ());
  EXPECT_LT(inside, 0.6F);
  EXPECT_GT(top, 0.85F);
  EXPECT_LT(field.openness(Vec3f(1, 1, 0.95F), -Vec3f::UnitZ()), top) << "looking into the pack";
}

TEST(OcclusionField, TheOpenIsFullyLit) {
  EXPECT_EQ(OcclusionField(packed_layer()).openness(Vec3f(9, 9, 9), Vec3f::UnitX()), 1);
  EXPECT_EQ(OcclusionField(std::vector<Capsule>{}).openness(Vec3f::Zero(), Vec3f::UnitX()), 1);
  const std::vector<Capsule> wire{{Vec3f::Zero(), Vec3f::UnitX(), 0.01F}};
  EXPECT_EQ(OcclusionField(wire).openness(Vec3f::Zero(), Vec3f::UnitX()), 1) << "wires hide no sky";
}

}  // namespace
}  // namespace lahar::cases
