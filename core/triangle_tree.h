#pragma once
// Distance to the nearest of many triangles: a tree of boxes over them.
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace lahar {

/// Square of the distance from a point to a triangle (Ericson 2005, Real-Time Collision Detection, 5.1.5).
double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

class TriangleTree {
 public:
  /// Keeps a reference to the mesh, which must have triangles.
  explicit TriangleTree(const TriangleMesh& mesh);
  /// Distance to the nearest triangle, m, or `limit` if none is nearer.
  [[nodiscard]] double distance(const Vec3& p, double limit) const;

 private:
  struct Node {
    Vec3 lower, upper;
    std::uint32_t first = 0, count = 0;  ///< triangles of a leaf
    std::uint32_t right = 0;             ///< second child; the first follows its parent
  };
  void build(std::uint32_t first, std::uint32_t count, const std::vector<Vec3>& middles);

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace lahar
