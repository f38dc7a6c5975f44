#include "coupling/wires/capsule_fraction.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace lahar::coupling {
namespace {

/// Volume at 4 and 8 cells a diameter, any direction and offset: 1 % rms.
TEST(CapsuleFraction, VolumeIsRight) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double r : {2.0, 4.0}) {
    double square = 0;
    const int samples = 20;
    for (int k = 0; k < samples; ++k) {
      const Vec3 axis = Vec3(uniform(random), uniform(random), uniform(random)).normalized() * 8;
      const Vec3 middle = Vec3::Constant(16) + 0.5 * Vec3(uniform(random), uniform(random), uniform(random));
      const Vec3 a = middle - axis, b = middle + axis;
      double sum = 0;
      for (int x = 0; x < 32; ++x)
        for (int y = 0; y < 32; ++y)
          for (int z = 0; z < 32; ++z)
            sum += capsule_fraction(Vec3(x + 0.5, y + 0.5, z + 0.5), a, b, capsule_mapping_radius(r));
      const double exact = std::numbers::pi * r * r * (16 + 4.0 / 3 * r);
      square += std::pow(sum / exact - 1, 2) / samples;
    }
    EXPECT_LT(std::sqrt(square), 0.01) << r;
  }
}

TEST(CapsuleFraction, IsASphereWithoutLength) {
  const Vec3 a(1, 2, 3);
  EXPECT_DOUBLE_EQ(segment_distance(Vec3(1, 2, 5), a, a), 2);
  EXPECT_DOUBLE_EQ(segment_distance(Vec3(4, 2, 3), a, Vec3(2, 2, 3)), 2);
  EXPECT_DOUBLE_EQ(segment_distance(Vec3(1.5, 3, 3), a, Vec3(2, 2, 3)), 1);
}

}  // namespace
}  // namespace lahar::coupling
