#include "core/triangle.h"

#include <gtest/gtest.h>

#include <random>

namespace lahar {
namespace {

TEST(Triangle, DistanceToFaceEdgeCornerAndNeedle) {
  const Triangle t{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
  EXPECT_DOUBLE_EQ(squared_distance({1, 1, 2}, t), 4);
  EXPECT_DOUBLE_EQ(squared_distance({2, -3, 0}, t), 9);
  EXPECT_DOUBLE_EQ(squared_distance({-3, -4, 0}, t), 25);
  EXPECT_NEAR(squared_distance({2 + 0.6, 1.5 + 0.8, 0}, t), 1, 1e-14);  // the slanted edge
  const Triangle needle{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_DOUBLE_EQ(squared_distance({1, 2, 0}, needle), 4);
}

TEST(Triangle, NoPointOfItIsNearerThanTheDistance) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto point = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  for (int n = 0; n < 200; ++n) {
    const Triangle t{point(), point(), point()};
    const Vec3 p = 2 * point();
    double nearest = 1e300;
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j <= 60 - i; ++j)
        nearest = std::min(nearest, (p - t.a - i / 60.0 * (t.b - t.a) - j / 60.0 * (t.c - t.a)).squaredNorm());
    EXPECT_LE(squared_distance(p, t), nearest + 1e-12);
    EXPECT_NEAR(std::sqrt(squared_distance(p, t)), std::sqrt(nearest), 0.03);
    EXPECT_TRUE(bounding_box(t).contains((t.a + t.b + t.c) / 3));
  }
}

}  // namespace
}  // namespace lahar
