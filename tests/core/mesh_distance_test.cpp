#include "core/mesh_distance.h"

#include <gtest/gtest.h>

#include <random>

#include "core/geometry.h"
#include "tests/core/shapes.h"

namespace lahar {
namespace {

std::vector<Vec3> points_in(const Vec3& lower, const Vec3& upper, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k)
    points.push_back(lower + (upper - lower).cwiseProduct(Vec3(unit(random), unit(random), unit(random))));
  return points;
}

TEST(TriangleMesh, KnowsWhatIsClosed) {
  TriangleMesh box = box_mesh(Vec3(0, 0, 0), Vec3(1, 2, 3));
  EXPECT_EQ(open_edges(box), 0u);
  EXPECT_NEAR(signed_volume(box), 6, 1e-12);
  flip(box);
  EXPECT_EQ(open_edges(box), 0u);
  EXPECT_NEAR(signed_volume(box), -6, 1e-12);
  std::swap(box.triangles[0][1], box.triangles[0][2]);  // one face that looks the other way
  EXPECT_EQ(open_edges(box), 3u);
  box.triangles.erase(box.triangles.begin());
  EXPECT_EQ(open_edges(box), 3u);
}

TEST(TriangleMesh, WeldingClosesASoup) {
  const TriangleMesh box = box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  TriangleMesh soup;
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    const auto n = static_cast<std::uint32_t>(soup.points.size());
    for (std::size_t k = 0; k < 3; ++k) soup.points.push_back(box.corner(t, k));
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  soup.triangles.push_back({0, 1, 1});
  EXPECT_GT(open_edges(soup), 0u);
  weld(soup);
  EXPECT_EQ(open_edges(soup), 0u);
  EXPECT_EQ(soup.points.size(), 8u);
  EXPECT_EQ(soup.triangles.size(), 12u);
}

/// A box whose faces, edges and corners lie on nodes (ties everywhere) and one that lies between them: the same
/// distances as the exact solid, within the band. Trilinear values are exact but where the distance has a kink (edges,
/// corners, the middle of the box): at most half a spacing there.
TEST(SampleDistance, IsThatOfTheBox) {
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(0.0123, 0.031, 0.0071)}) {
    const SolidBox exact{Vec3(0.2, 0.3, 0.1) + shift, Vec3(0.6, 0.5, 0.7) + shift};
    const double h = 0.025, band = 0.1;
    const auto grid = sample_distance(box_mesh(exact.lower, exact.upper), Vec3(0, 0, 0), Vec3(1, 1, 1), h, band);
    int inside = 0;
    for (const Vec3& p : points_in(Vec3(0, 0, 0), Vec3(1, 1, 1), 4000)) {
      const double d = exact.distance(p), sampled = grid->distance(p);
      EXPECT_NEAR(sampled, d, std::abs(d) < band ? 0.5 * h : 4 * h);  // coarse nodes are eight spacings apart
      EXPECT_TRUE(std::abs(d) < 0.3 * h || (sampled < 0) == (d < 0));
      inside += d < 0;
    }
    EXPECT_GT(inside, 100);
    EXPECT_NEAR(grid->distance({0.4 + shift.x(), 0.4 + shift.y(), 0.69 + shift.z()}), -0.01, 1e-6);
    EXPECT_LT((grid->gradient({0.4 + shift.x(), 0.4 + shift.y(), 0.71 + shift.z()}) - Vec3::UnitZ()).norm(), 1e-3);
  }
}

/// Cells whose centre lies on a face must fall on the same side whatever describes the wall.
TEST(SampleDistance, PointsOnTheSurfaceAreFree) {
  const SolidBox exact{Vec3(0.6, 0.05, 0.1), Vec3(0.68, 0.15, 0.3)};
  const auto grid =
      sample_distance(box_mesh(exact.lower, exact.upper), Vec3(0.5, 0, 0), Vec3(0.8, 0.2, 0.4), 0.01, 0.04);
  for (const double x : {0.6, 0.61, 0.65, 0.68})
    for (const double z : {0.11, 0.2, 0.29})
      for (const double y : {0.05, 0.15}) {
        EXPECT_GE(grid->distance({x, y, z}), 0);
        EXPECT_LT(grid->distance({x, y, z}), 1e-6);
      }
}

TEST(SampleDistance, ConvergesWithSecondOrderOnASphere) {
  const SolidSphere exact{Vec3(0.5, 0.48, 0.53), 0.3};
  const TriangleMesh mesh = sphere_mesh(exact.centre, exact.radius, 200);  // its own facets: 4e-5 m
  double error[2] = {0, 0};
  for (int k = 0; k < 2; ++k) {
    const double h = k == 0 ? 0.04 : 0.02;
    const auto grid = sample_distance(mesh, Vec3(0.1, 0.1, 0.1), Vec3(0.9, 0.9, 0.9), h, 2 * h);
    for (const Vec3& p : points_in(Vec3(0.1, 0.1, 0.1), Vec3(0.9, 0.9, 0.9), 4000)) {
      if (std::abs(exact.distance(p)) > 0.03) continue;
      error[k] = std::max(error[k], std::abs(grid->distance(p) - exact.distance(p)));
    }
  }
  EXPECT_LT(error[1], 0.001);
  EXPECT_GT(error[0] / error[1], 3);
}

/// Ground that rises like a roof: solid below, free above, however high.
TEST(SampleDistance, TerrainIsSolidBelow) {
  TriangleMesh roof;
  roof.points = {{-1, -1, 0}, {2, -1, 0}, {2, 0.5, 0.75}, {-1, 0.5, 0.75}, {2, 2, 0}, {-1, 2, 0}};
  roof.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}};
  const auto grid = sample_distance(roof, Vec3(0, 0, 0), Vec3(1, 1, 1.2), 0.02, 0.1);
  const double cosine = 2 / std::sqrt(5.0);  // of the slope
  EXPECT_NEAR(grid->distance({0.5, 0.2, 0.62}), 0.02 * cosine, 1e-6);
  EXPECT_NEAR(grid->distance({0.3, 0.8, 0.58}), -0.02 * cosine, 1e-6);
  EXPECT_LT(grid->distance({0.5, 0.5, 0.02}), -0.3);
  EXPECT_GT(grid->distance({0.5, 0.5, 1.19}), 0.3);
  EXPECT_NEAR(grid->distance({0.5, 0.2, 5}) - grid->distance({0.5, 0.2, 4}), 1, 1e-6);  // outside the grid
  EXPECT_LT(grid->distance({0.5, 0.2, -3}), -3);
}

}  // namespace
}  // namespace lahar
