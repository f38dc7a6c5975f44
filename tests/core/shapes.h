#pragma once
// Closed surfaces for tests.
#include <cmath>
#include <memory>

#include "core/distance_grid.h"
#include "core/triangle_mesh.h"

namespace lahar {

/// Twelve triangles that look outwards.
inline TriangleMesh box_mesh(const Vec3& lower, const Vec3& upper) {
  TriangleMesh m;
  for (int k = 0; k < 8; ++k)
    m.points.emplace_back(k & 1 ? upper.x() : lower.x(), k & 2 ? upper.y() : lower.y(), k & 4 ? upper.z() : lower.z());
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

/// A sphere of latitudes and longitudes, corners on the sphere.
inline TriangleMesh sphere_mesh(const Vec3& centre, double radius, std::uint32_t around) {
  TriangleMesh m;
  const std::uint32_t up = around / 2;
  for (std::uint32_t i = 0; i <= up; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const double theta = M_PI * i / up, phi = 2 * M_PI * k / around;
      const double s = i == 0 || i == up ? 0.0 : std::sin(theta);  // all points of a pole are one
      m.points.push_back(centre + radius * Vec3(s * std::cos(phi), s * std::sin(phi), std::cos(theta)));
    }
  for (std::uint32_t i = 0; i < up; ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around, c = a + around, d = b + around;
      m.triangles.push_back({a, c, d});
      m.triangles.push_back({a, d, b});
    }
  weld(m);
  return m;
}

/// Samples of a distance, fine everywhere.
template <class Distance>
std::shared_ptr<const DistanceGrid> sampled(const Vec3& lower, const Vec3& upper, double spacing,
                                            const Distance& distance) {
  auto grid = std::make_shared<DistanceGrid>(lower, upper, spacing);
  const auto at = [&](const Vec3i& node) { return static_cast<float>(distance(grid->node(node))); };
  std::vector<Vec3i> all;
  const Vec3i bricks = grid->bricks();
  for (int x = 0; x <= bricks.x(); ++x)
    for (int y = 0; y <= bricks.y(); ++y)
      for (int z = 0; z <= bricks.z(); ++z) {
        grid->coarse({x, y, z}) = at(DistanceGrid::brick_cells * Vec3i(x, y, z));
        if (x < bricks.x() && y < bricks.y() && z < bricks.z()) all.emplace_back(x, y, z);
      }
  grid->refine(all);
  for (std::size_t k = 0; k < all.size(); ++k)
    for (int x = 0; x < 9; ++x)
      for (int y = 0; y < 9; ++y)
        for (int z = 0; z < 9; ++z)
          grid->fine(k)[81 * x + 9 * y + z] = at(DistanceGrid::brick_cells * all[k] + Vec3i(x, y, z));
  return grid;
}

}  // namespace lahar
