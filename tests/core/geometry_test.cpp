#include "core/geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace lahar {
namespace {

const SolidBox box{{-0.3, -0.2, 0.1}, {0.4, 0.5, 0.6}};
const SolidCylinder cylinder{{0.1, -0.2, 0.3}, {0.5, 0.3, 0.8}, 0.25};
const SolidSphere sphere{{0.2, -0.1, 0.4}, 0.35};
const HalfSpace half_space{{0.1, 0.2, 0.3}, Vec3(1, -2, 2).normalized()};

std::vector<Vec3> random_points(int count, double half_width, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(-half_width, half_width);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.emplace_back(u(random), u(random), u(random));
  return points;
}

// Points that cover the surface with a spacing of at most `spacing`: the distance to the nearest of them is the
// distance to the surface up to that spacing, whatever formula the code uses.
std::vector<Vec3> surface_points(const SolidBox& b, double spacing) {
  std::vector<Vec3> points;
  const Vec3 size = b.upper - b.lower;
  for (int axis = 0; axis < 3; ++axis) {
    const int v = (axis + 1) % 3, w = (axis + 2) % 3;
    const int nv = static_cast<int>(std::ceil(size[v] / spacing)), nw = static_cast<int>(std::ceil(size[w] / spacing));
    for (int i = 0; i <= nv; ++i)
      for (int j = 0; j <= nw; ++j)
        for (const double end : {b.lower[axis], b.upper[axis]}) {
          Vec3 p;
          p[axis] = end;
          p[v] = b.lower[v] + size[v] * i / nv;
          p[w] = b.lower[w] + size[w] * j / nw;
          points.push_back(p);
        }
  }
  return points;
}

std::vector<Vec3> surface_points(const SolidCylinder& c, double spacing) {
  const Vec3 axis = (c.end - c.start).normalized();
  const Vec3 e1 = axis.unitOrthogonal(), e2 = axis.cross(e1);
  const double length = (c.end - c.start).norm();
  const int turns = static_cast<int>(std::ceil(2 * std::numbers::pi * c.radius / spacing));
  const int along = static_cast<int>(std::ceil(length / spacing));
  const int across = static_cast<int>(std::ceil(c.radius / spacing));
  std::vector<Vec3> points;
  for (int t = 0; t < turns; ++t) {
    const double angle = 2 * std::numbers::pi * t / turns;
    const Vec3 out = std::cos(angle) * e1 + std::sin(angle) * e2;
    for (int k = 0; k <= along; ++k) points.emplace_back(c.start + axis * (length * k / along) + c.radius * out);
    for (int k = 0; k <= across; ++k)
      for (const Vec3& centre : {c.start, c.end}) points.emplace_back(centre + out * (c.radius * k / across));
  }
  return points;
}

double distance_to_points(const std::vector<Vec3>& points, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& s : points) nearest = std::min(nearest, (s - p).squaredNorm());
  return std::sqrt(nearest);
}

bool inside(const SolidBox& b, const Vec3& p) {
  return (p.array() > b.lower.array()).all() && (p.array() < b.upper.array()).all();
}

bool inside(const SolidCylinder& c, const Vec3& p) {
  const Vec3 axis = (c.end - c.start).normalized();
  const double along = (p - c.start).dot(axis);
  return along > 0 && along < (c.end - c.start).norm() && (p - c.start - along * axis).norm() < c.radius;
}

template <class S>
void expect_distance_of_sampled_surface(const S& shape) {
  constexpr double spacing = 0.01;
  const auto surface = surface_points(shape, spacing);
  int within = 0;
  for (const Vec3& p : random_points(300, 1.0, 11)) {
    const double distance = shape.distance(p);
    EXPECT_NEAR(std::abs(distance), distance_to_points(surface, p), spacing) << p.transpose();
    EXPECT_EQ(distance < 0, inside(shape, p)) << p.transpose();
    within += distance < 0;
  }
  EXPECT_GT(within, 0) << "no point fell inside: the sign was not tested";
}

TEST(SolidBox, DistanceAndSignMatchASampledSurface) { expect_distance_of_sampled_surface(box); }

TEST(SolidCylinder, DistanceAndSignMatchASampledSurface) { expect_distance_of_sampled_surface(cylinder); }

TEST(SolidBox, ExactAtFaceEdgeCornerAndCentre) {
  const SolidBox unit{{0, 0, 0}, {1, 2, 4}};
  EXPECT_DOUBLE_EQ(unit.distance({1.5, 1, 2}), 0.5);
  EXPECT_DOUBLE_EQ(unit.distance({1.3, 2.4, 2}), 0.5);
  EXPECT_DOUBLE_EQ(unit.distance({-1, -2, -2}), 3);
  EXPECT_DOUBLE_EQ(unit.distance({0.5, 1, 2}), -0.5);
  EXPECT_DOUBLE_EQ(unit.distance({0.5, 1, 0}), 0);
}

TEST(SolidCylinder, ExactBesideAboveAndAtTheRim) {
  const SolidCylinder c{{0, 0, 0}, {0, 0, 2}, 1};
  EXPECT_DOUBLE_EQ(c.distance({3, 0, 1}), 2);
  EXPECT_DOUBLE_EQ(c.distance({0.2, 0, 2.5}), 0.5);
  EXPECT_DOUBLE_EQ(c.distance({0, 4, 6}), 5);
  EXPECT_DOUBLE_EQ(c.distance({0.7, 0, 1}), -0.3);
  EXPECT_DOUBLE_EQ(c.distance({0, 0.1, 1.8}), -0.2);
}

TEST(SolidSphere, DistanceIsThatToTheCentreLessTheRadius) {
  EXPECT_DOUBLE_EQ(sphere.distance(sphere.centre + Vec3(0, 0, 1)), 0.65);
  EXPECT_DOUBLE_EQ(sphere.distance(sphere.centre), -0.35);
}

TEST(HalfSpace, FreeSpaceLiesOnTheSideOfTheNormal) {
  EXPECT_NEAR(half_space.distance(half_space.point + 0.7 * half_space.normal), 0.7, 1e-15);
  EXPECT_NEAR(half_space.distance(half_space.point - 0.7 * half_space.normal), -0.7, 1e-15);
  EXPECT_NEAR(half_space.distance(half_space.point + half_space.normal.unitOrthogonal()), 0, 1e-15);
}

template <class S>
Vec3 central_difference(const S& shape, const Vec3& p, double h) {
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = h * Vec3::Unit(axis);
    g[axis] = (shape.distance(p + step) - shape.distance(p - step)) / (2 * h);
  }
  return g;
}

// Where the difference quotient has not length 1, the points straddle a ridge of the distance (equally near to two
// faces): there the gradient is not defined and the point is left out.
template <class S>
void expect_gradient_of_distance(const S& shape) {
  int compared = 0;
  for (const Vec3& p : random_points(500, 1.0, 5)) {
    EXPECT_NEAR(shape.gradient(p).norm(), 1, 1e-12) << p.transpose();
    const Vec3 g = central_difference(shape, p, 1e-6);
    if (std::abs(g.norm() - 1) > 1e-6) continue;
    EXPECT_LT((shape.gradient(p) - g).norm(), 1e-5) << p.transpose();
    ++compared;
  }
  EXPECT_GT(compared, 490);
}

TEST(HalfSpace, GradientIsThatOfTheDistance) { expect_gradient_of_distance(half_space); }
TEST(SolidBox, GradientIsThatOfTheDistance) { expect_gradient_of_distance(box); }
TEST(SolidCylinder, GradientIsThatOfTheDistance) { expect_gradient_of_distance(cylinder); }
TEST(SolidSphere, GradientIsThatOfTheDistance) { expect_gradient_of_distance(sphere); }

// Walking the distance along the gradient ends on the surface: what wall contact and link-wise distances rely on.
template <class S>
void expect_projection_on_surface(const S& shape) {
  for (const Vec3& p : random_points(300, 1.0, 23)) {
    if (shape.distance(p) <= 0) continue;
    EXPECT_NEAR(shape.distance(p - shape.distance(p) * shape.gradient(p)), 0, 1e-12) << p.transpose();
  }
}

TEST(SolidBox, GradientLeadsToTheSurface) { expect_projection_on_surface(box); }
TEST(SolidCylinder, GradientLeadsToTheSurface) { expect_projection_on_surface(cylinder); }
TEST(SolidSphere, GradientLeadsToTheSurface) { expect_projection_on_surface(sphere); }

TEST(Gradient, IsAUnitVectorWhereItIsNotDefined) {
  EXPECT_NEAR(sphere.gradient(sphere.centre).norm(), 1, 1e-15);
  EXPECT_NEAR(box.gradient(0.5 * (box.lower + box.upper)).norm(), 1, 1e-15);
  EXPECT_NEAR(cylinder.gradient(0.5 * (cylinder.start + cylinder.end)).norm(), 1, 1e-15);
}

Walls channel() {
  Walls walls;
  walls.add({"bed", HalfSpace{{0, 0, 0}, Vec3::UnitZ()}});
  walls.add({"side", HalfSpace{{0, -1, 0}, Vec3::UnitY()}});
  walls.add({"post", SolidCylinder{{1, 0, 0}, {1, 0, 1}, 0.1}});
  return walls;
}

TEST(Walls, NearestIsTheSmallestDistanceWithItsNormal) {
  const Walls walls = channel();
  for (const Vec3& p : random_points(200, 0.9, 3)) {
    const WallPoint nearest = walls.nearest(p);
    ASSERT_GE(nearest.wall, 0);
    const auto wall = static_cast<std::size_t>(nearest.wall);
    for (std::size_t w = 0; w < walls.all().size(); ++w) EXPECT_LE(nearest.distance, walls.distance(w, p));
    EXPECT_EQ(nearest.distance, walls.distance(wall, p));
    EXPECT_EQ(nearest.normal, walls.gradient(wall, p));
  }
}

TEST(Walls, NearestOfAKnownPoint) {
  const WallPoint nearest = channel().nearest({0.5, 0, 0.6});
  EXPECT_EQ(nearest.wall, 2);
  EXPECT_NEAR(nearest.distance, 0.4, 1e-15);
  EXPECT_NEAR((nearest.normal - Vec3(-1, 0, 0)).norm(), 0, 1e-15);
}

/// A wall that opens is nowhere from then on; the others keep their indices.
TEST(Walls, OpenWhenTheirTimeHasCome) {
  Walls walls = channel();
  Wall gate{"gate", HalfSpace{{0.5, 0, 0}, -Vec3::UnitX()}};
  gate.opens_at = 2;
  walls.add(gate);
  EXPECT_FALSE(walls.open_by(1.99));
  EXPECT_LT(walls.distance(3, {0.6, 0, 0.1}), 0);
  EXPECT_EQ(walls.nearest({0.6, 0, 0.1}).wall, 3);
  EXPECT_TRUE(walls.open_by(2));
  EXPECT_FALSE(walls.open_by(3)) << "it is open already";
  EXPECT_EQ(walls.distance(3, {0.6, 0, 0.1}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(walls.nearest({0.6, 0, 0.1}).wall, 0);
}

TEST(Walls, WithoutWallsEverythingIsFree) {
  const Walls none;
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.nearest({1, 2, 3}).wall, -1);
  EXPECT_EQ(none.nearest({1, 2, 3}).distance, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace lahar
