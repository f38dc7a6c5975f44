#include "barrier/linking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lahar::barrier {
namespace {

using std::numbers::pi;

/// A unit circle about `centre` in the plane of u and v.
Polyline circle(const Vec3& centre, const Vec3& u, const Vec3& v, int points = 36) {
  return even_polyline([&](double t) { return Vec3(centre + std::cos(2 * pi * t) * u + std::sin(2 * pi * t) * v); },
                       points, true);
}

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

TEST(Linking, HopfLinkIsOneUpToSign) {
  const Polyline a = circle(Vec3::Zero(), x, y), b = circle(x, x, z);
  const double number = linking_number(a, b);
  EXPECT_NEAR(std::abs(number), 1, 1e-12);
  EXPECT_NEAR(linking_number(b, a), number, 1e-12);                  // symmetric
  EXPECT_NEAR(linking_number(a, circle(x, x, -z)), -number, 1e-12);  // the other way around
}

TEST(Linking, SeparateCirclesAreNot) {
  const Polyline a = circle(Vec3::Zero(), x, y);
  EXPECT_NEAR(linking_number(a, circle(3 * x, x, z)), 0, 1e-12);
  EXPECT_NEAR(linking_number(a, circle(0.3 * z, x, y)), 0, 1e-12);            // stacked
  EXPECT_NEAR(linking_number(a, circle(0.5 * x + 1.5 * z, x, z)), 0, 1e-12);  // above
  EXPECT_NEAR(linking_number(a, circle(2.5 * x, x, y)), 0, 1e-12);            // in the same plane
}

TEST(Linking, ChainLinksNeighboursOnly) {
  const Polyline a = circle(Vec3::Zero(), x, y), b = circle(1.5 * x, x, z), c = circle(3 * x, x, y);
  EXPECT_EQ(std::abs(links(a, b)), 1);
  EXPECT_EQ(std::abs(links(b, c)), 1);
  EXPECT_EQ(links(a, c), 0);
}

TEST(Linking, CountsWindingsOfATorusCurve) {
  for (const int turns : {2, 3, 5}) {
    const Polyline torus = even_polyline(
        [&](double t) {
          const double r = 1 + 0.4 * std::cos(2 * pi * turns * t);
          return Vec3(r * std::cos(2 * pi * t), r * std::sin(2 * pi * t), 0.4 * std::sin(2 * pi * turns * t));
        },
        200, true);
    EXPECT_NEAR(std::abs(linking_number(circle(Vec3::Zero(), x, y, 90), torus)), turns, 1e-9);
  }
}

TEST(Linking, HairpinThroughARingAndBackIsZero) {
  const Polyline hairpin{{{-0.2, 0, 3}, {-0.2, 0, -1}, {0.2, 0, -1}, {0.2, 0, 3}}, true};
  EXPECT_NEAR(linking_number(circle(Vec3::Zero(), x, y), hairpin), 0, 1e-12);
}

TEST(Linking, ThreadThroughARingAndBesideIt) {
  const Polyline ring = circle(Vec3::Zero(), x, y);
  const Polyline through{{{0.3, 0, -2}, {0.3, 0, 0.1}, {0.3, 0, 2}}, false};
  const Polyline back{{{0.3, 0, 2}, {0.3, 0, 0.1}, {0.3, 0, -2}}, false};
  const Polyline beside{{{1.3, 0, -2}, {1.3, 0, 0.1}, {1.3, 0, 2}}, false};
  EXPECT_EQ(std::abs(links_with_thread(ring, through)), 1);
  EXPECT_EQ(links_with_thread(ring, back), -links_with_thread(ring, through));
  EXPECT_EQ(links_with_thread(ring, beside), 0);
}

}  // namespace
}  // namespace lahar::barrier
