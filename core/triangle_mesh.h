#pragma once
// Triangles with shared corners.
#include <array>
#include <cstdint>
#include <vector>

#include "core/vector.h"

namespace lahar {

struct TriangleMesh {
  std::vector<Vec3> points;                             ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< corners, anticlockwise seen from outside

  [[nodiscard]] const Vec3& corner(std::size_t triangle, std::size_t k) const { return points[triangles[triangle][k]]; }
};

/// Makes one point of points with equal coordinates, and drops triangles that have a corner twice then.
void weld(TriangleMesh& mesh);

/// Edges that are not passed as often one way as the other: 0 for a closed surface with faces that agree on outside.
std::size_t open_edges(const TriangleMesh& mesh);

/// Enclosed volume of a closed mesh, m^3 (divergence theorem); below 0 where the faces look inwards.
double signed_volume(const TriangleMesh& mesh);

/// Turns all faces round.
void flip(TriangleMesh& mesh);

struct Bounds {
  Vec3 lower, upper;
};
/// Of all corners; the mesh must have points.
Bounds bounds_of(const TriangleMesh& mesh);

}  // namespace lahar
