#include "barrier/polyline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lahar::barrier {
namespace {

using std::numbers::pi;

TEST(Polyline, SpacesPointsEvenlyOnCurvesOfUnevenSpeed) {
  const Curve helix = [](double t) { return Vec3(t * t, 0.2 * std::sin(9 * t), 0.2 * std::cos(9 * t)); };
  const Polyline line = even_polyline(helix, 40, false);
  ASSERT_EQ(line.points.size(), 40u);
  EXPECT_LT((line.points.front() - helix(0)).norm() + (line.points.back() - helix(1)).norm(), 1e-12);
  const double mean = length(line) / 39;
  for (std::size_t s = 0; s < line.segments(); ++s)
    EXPECT_NEAR((line.end(s) - line.start(s)).norm(), mean, 1e-6 * mean);
}

TEST(Polyline, ClosedCircleHasThePerimeterOfItsPolygon) {
  const Curve circle = [](double t) { return Vec3(std::cos(2 * pi * t), std::sin(2 * pi * t), 0); };
  EXPECT_NEAR(length(even_polyline(circle, 17, true)), 34 * std::sin(pi / 17), 1e-9);
}

TEST(Polyline, NearestPointsOfSegmentsInEveryRelation) {
  const Vec3 o = Vec3::Zero(), x = Vec3::UnitX();
  const Nearest crossing = nearest_points(o, x, {0.25, -1, 2}, {0.25, 1, 2});
  EXPECT_NEAR(crossing.s, 0.25, 1e-15);
  EXPECT_NEAR(crossing.t, 0.5, 1e-15);
  EXPECT_NEAR(crossing.apart.z(), -2, 1e-15);
  EXPECT_NEAR(nearest_points(o, x, {3, 4, 0}, {3, 9, 0}).apart.norm(), std::sqrt(20.0), 1e-14);  // end to end
  EXPECT_NEAR(nearest_points(o, x, {0.5, 3, 0}, {0.5, 9, 0}).apart.norm(), 3, 1e-14);            // end to middle
  EXPECT_NEAR(nearest_points(o, x, {-2, 1, 0}, {2, 1, 0}).apart.norm(), 1, 1e-14);               // parallel
  EXPECT_NEAR(nearest_points(o, x, {2, 0, 0}, {5, 0, 0}).apart.norm(), 1, 1e-14);                // in line
}

TEST(Polyline, DistanceTakesTheShiftOfTheSecond) {
  const Polyline a{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, false}, b{{{1.5, 1, 0}, {1.5, 2, 0}}, false};
  EXPECT_NEAR(distance(a, b, Vec3::Zero(), 10), 1, 1e-14);
  EXPECT_NEAR(distance(a, b, {0, 0.5, 0}, 10), 1.5, 1e-14);
  EXPECT_EQ(distance(a, b, {0, 50, 0}, 10), 10);
}

}  // namespace
}  // namespace lahar::barrier
