#include "core/bounding_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/triangle.h"
#include "core/triangle_mesh.h"
#include "tests/core/shapes.h"

namespace lahar {
namespace {

struct Ball {
  Eigen::Vector3d centre;
  double radius;
};

Eigen::AlignedBox3d bounding_box(const Ball& b) {
  return {b.centre - Vec3::Constant(b.radius), b.centre + Vec3::Constant(b.radius)};
}

double distance(const Ball& b, const Vec3& p) { return std::max(0.0, (p - b.centre).norm() - b.radius); }

// Large and small balls, as boulders among beads are.
std::vector<Ball> many_balls(int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Ball> balls;
  for (int n = 0; n < count; ++n)
    balls.push_back({Vec3(unit(random), unit(random), 0.2 * unit(random)), n % 40 == 0 ? 0.05 : 0.004});
  return balls;
}

struct Nearest {
  double distance;
  std::uint32_t item;
  int visits;
};

Nearest nearest(const BoundingTree<Ball>& tree, const Vec3& p, double limit) {
  Nearest found{limit, ~0U, 0};
  double limit2 = limit * limit;
  tree.visit(SquaredDistanceFrom<double>{p}, limit2, [&](std::uint32_t i) {
    ++found.visits;
    const double d = distance(tree.items()[i], p);
    if (d < found.distance) found.distance = d, found.item = i, limit2 = d * d;
  });
  return found;
}

TEST(BoundingTree, TheNearestItemIsThatOfTryingAll) {
  const BoundingTree<Ball> tree(many_balls(3000));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-0.5, 1.5);
  double visits = 0;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p(unit(random), unit(random), unit(random));
    double least = 1e300;
    for (const Ball& b : tree.items()) least = std::min(least, distance(b, p));
    const Nearest found = nearest(tree, p, 1e100);
    EXPECT_EQ(found.distance, least);
    EXPECT_EQ(distance(tree.items()[found.item], p), least);
    EXPECT_EQ(nearest(tree, p, 0.9 * least).item, ~0U) << "beyond the limit";
    visits += found.visits;
  }
  EXPECT_LT(visits / 500, 0.03 * 3000) << "the boxes spare nothing";
}

TEST(BoundingTree, TheNearestTriangleIsThatOfTryingAll) {
  const TriangleMesh mesh = sphere_mesh(Vec3(0.1, 0.2, 0.3), 0.7, 24);
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    triangles.push_back({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
  const BoundingTree<Triangle> tree(triangles);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-2, 2);
  for (int n = 0; n < 300; ++n) {
    const Vec3 p(unit(random), unit(random), unit(random));
    double least = 1e300, found = 1e300;
    for (const Triangle& t : triangles) least = std::min(least, squared_distance(p, t));
    tree.visit(SquaredDistanceFrom<double>{p}, found,
               [&](std::uint32_t t) { found = std::min(found, squared_distance(p, triangles[t])); });
    EXPECT_NEAR(found, least, 1e-14);
  }
}

TEST(BoundingTree, ARayMeetsEveryBoxOnItsWayInOrder) {
  const BoundingTree<Ball> tree(many_balls(20000));
  const Vec3 origin(-1, 0.4, 0.1), direction = Vec3(1, 0.1, 0).normalized();
  const EntryOfRay<double> entry(origin, direction);
  std::vector<bool> visited(tree.items().size());
  double limit = std::numeric_limits<double>::infinity();
  tree.visit(entry, limit, [&](std::uint32_t i) { visited[i] = true; });
  int hit = 0;
  for (std::size_t i = 0; i < visited.size(); ++i) {
    if (entry(bounding_box(tree.items()[i])) == std::numeric_limits<double>::infinity()) continue;
    EXPECT_TRUE(visited[i]);
    ++hit;
  }
  EXPECT_GT(hit, 3);
  int first = 0;
  tree.visit(entry, limit, [&](std::uint32_t) { ++first, limit = -1; });
  EXPECT_LE(first, 3) << "goes on after the limit fell below 0";
}

TEST(BoundingTree, EntryOfARay) {
  const Eigen::AlignedBox3f box(Eigen::Vector3f(1, -1, -1), Eigen::Vector3f(2, 1, 1));
  const auto entry = [&](const Eigen::Vector3f& from, const Eigen::Vector3f& along) {
    return EntryOfRay<float>(from, along)(box);
  };
  EXPECT_FLOAT_EQ(entry({0, 0, 0}, Eigen::Vector3f::UnitX()), 1);
  EXPECT_FLOAT_EQ(entry({1.5F, 0, 0}, Eigen::Vector3f::UnitY()), 0) << "inside";
  EXPECT_TRUE(std::isinf(entry({0, 0, 0}, -Eigen::Vector3f::UnitX()))) << "behind";
  EXPECT_TRUE(std::isinf(entry({0, 3, 0}, Eigen::Vector3f::UnitX()))) << "beside";
}

TEST(BoundingTree, CopesWithNothingAndWithManyInOnePlace) {
  EXPECT_EQ(nearest(BoundingTree<Ball>({}), Vec3::Zero(), 1e100).visits, 0);
  const BoundingTree<Ball> heap(std::vector<Ball>(5000, Ball{Vec3::Ones(), 0.5}));
  EXPECT_DOUBLE_EQ(nearest(heap, Vec3(3, 1, 1), 1e100).distance, 1.5);
}

}  // namespace
}  // namespace lahar
