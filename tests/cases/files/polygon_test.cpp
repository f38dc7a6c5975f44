#include "cases/files/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lahar::cases {
namespace {

std::vector<std::uint32_t> in_turn(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> corners(mesh.points.size());
  std::iota(corners.begin(), corners.end(), 0U);
  return corners;
}

/// m^2, each as seen from above.
std::vector<double> areas(const TriangleMesh& mesh) {
  std::vector<double> all;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    all.push_back((mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).z() / 2);
  return all;
}

/// All triangles look up and add up to the face: none lies outside.
void expect_cover(TriangleMesh mesh, double area) {
  ASSERT_TRUE(add_face(mesh, in_turn(mesh)));
  EXPECT_EQ(mesh.triangles.size(), mesh.points.size() - 2);
  const std::vector<double> all = areas(mesh);
  for (const double a : all) EXPECT_GE(a, -1e-12);
  EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), area, 1e-9 * area);
}

TEST(Polygon, ConvexFacesAreFans) {
  TriangleMesh mesh;
  for (int k = 0; k < 7; ++k) mesh.points.emplace_back(std::cos(0.9 * k), std::sin(0.9 * k), 0.1 * k);
  mesh.points.insert(mesh.points.begin() + 1, 0.5 * (mesh.points[0] + mesh.points[1]));  // on an edge
  ASSERT_TRUE(add_face(mesh, in_turn(mesh)));
  ASSERT_EQ(mesh.triangles.size(), 6U);
  for (std::uint32_t k = 0; k < 6; ++k) EXPECT_EQ(mesh.triangles[k], (std::array<std::uint32_t, 3>{0, k + 1, k + 2}));
}

/// From whichever corner it begins.
TEST(Polygon, AnLShapeIsCovered) {
  for (int shift = 0; shift < 6; ++shift) {
    TriangleMesh mesh;
    mesh.points = {{0, 0, 5}, {4, 0, 5}, {4, 1, 5}, {1, 1, 5}, {1, 3, 5}, {0, 3, 5}};
    std::rotate(mesh.points.begin(), mesh.points.begin() + shift, mesh.points.end());
    expect_cover(mesh, 6);
  }
}

TEST(Polygon, ACombWithCornersOnItsEdgesIsCovered) {
  TriangleMesh mesh;
  for (int k = 0; k <= 10; ++k) mesh.points.emplace_back(k, 0, 0);
  for (int k = 5; k > 0; --k) {
    mesh.points.emplace_back(2 * k, 3, 0);
    mesh.points.emplace_back(2 * k - 1, 3, 0);
    mesh.points.emplace_back(2 * k - 1, 1, 0);
    mesh.points.emplace_back(2 * k - 2, 1, 0);
  }
  expect_cover(mesh, 5 * 4);
}

TEST(Polygon, ASpiralIsCovered) {
  TriangleMesh mesh;
  double area = 0;
  for (int k = 0; k <= 24; ++k) {
    const double phi = M_PI * k / 4, radius = 1 + k / 8.0;
    mesh.points.emplace_back(radius * std::cos(phi), radius * std::sin(phi), 0);
  }
  for (int k = 24; k >= 0; --k)
    mesh.points.push_back(mesh.points[static_cast<std::size_t>(k)] * (1 - 0.2 / (1 + k / 8.0)));
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    area += mesh.points[k].cross(mesh.points[(k + 1) % mesh.points.size()]).z() / 2;
  expect_cover(mesh, area);
}

/// A hole whose outline is tied to the outer one by a slit.
/// A plate of 10 m with seven slots of 1 cm, whose round ends have edges of a millimetre, from whichever corner on:
/// what lies on an edge is judged by that edge, not by the longest.
TEST(Polygon, AFaceOfLongAndShortEdgesIsCovered) {
  std::vector<Vec3> outline{{0, 0, 0}};
  constexpr double r = 0.005, deep = 0.1;
  for (int slot = 0; slot < 7; ++slot) {
    const double x = 1 + slot;
    outline.emplace_back(x - r, 0, 0);
    for (int k = 0; k <= 12; ++k) {
      const double a = M_PI * (1 - k / 12.0);
      outline.emplace_back(x + r * std::cos(a), deep + r * std::sin(a), 0);
    }
    outline.emplace_back(x + r, 0, 0);
  }
  outline.insert(outline.end(), {{10, 0, 0}, {10, 0.2, 0}, {0, 0.2, 0}});
  const double round = 6 * r * r * std::sin(M_PI / 12), area = 10 * 0.2 - 7 * (2 * r * deep + round);
  for (std::size_t first = 0; first < outline.size(); ++first) {
    TriangleMesh mesh;
    for (std::size_t k = 0; k < outline.size(); ++k) mesh.points.push_back(outline[(first + k) % outline.size()]);
    expect_cover(mesh, area);
  }
}

TEST(Polygon, AFaceWithAHoleIsCovered) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
  ASSERT_TRUE(add_face(mesh, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4}));
  const std::vector<double> all = areas(mesh);
  for (const double a : all) EXPECT_GE(a, 0);
  EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 8, 1e-12);
}

TEST(Polygon, FacesThatCrossThemselvesAreRefused) {
  for (const double height : {1.0, 0.5}) {
    TriangleMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, height, 0}};
    EXPECT_FALSE(add_face(mesh, in_turn(mesh))) << height;
    EXPECT_TRUE(mesh.triangles.empty());
  }
}

/// They have no plane of their own, and no area either.
TEST(Polygon, FacesOnALineAreKept) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  EXPECT_TRUE(add_face(mesh, in_turn(mesh)));
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

}  // namespace
}  // namespace lahar::cases
