#include "core/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/bounding_tree.h"
#include "core/parallel.h"
#include "core/triangle.h"

namespace lahar {

namespace {

struct Crossing {
  std::uint64_t column;
  double z;
  int sign;  ///< +1 where the face looks up
};

/// Where lines along z through the nodes of a grid cross the triangles.
class Columns {
 public:
  Columns(const TriangleMesh& mesh, const DistanceGrid& grid)
      : rows_(static_cast<std::uint64_t>(DistanceGrid::brick_cells * grid.bricks().y() + 1)) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) cross(mesh, t, grid);
    std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
      return std::tuple(a.column, a.z, a.sign) < std::tuple(b.column, b.z, b.sign);
    });
    first_.assign(rows_ * static_cast<std::uint64_t>(DistanceGrid::brick_cells * grid.bricks().x() + 1) + 1, 0);
    for (const Crossing& c : crossings_) ++first_[c.column + 1];
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  }

  /// How often the ray from height z upwards leaves the solid more than it enters it.
  [[nodiscard]] int winding(int x, int y, double z) const {
    const std::uint64_t column = static_cast<std::uint64_t>(x) * rows_ + static_cast<std::uint64_t>(y);
    int sum = 0;
    for (std::size_t k = first_[column]; k < first_[column + 1]; ++k)
      if (crossings_[k].z > z) sum += crossings_[k].sign;
    return sum;
  }

 private:
  using Point = Eigen::Vector2d;

  /// Twice the area of (u, v, q), > 0 if anticlockwise, seen with the ends in a fixed order so that the two triangles
  /// of an edge agree to the last bit, and with the tie of a point on the line broken as if it stood a trifle to the
  /// right and a still smaller trifle up.
  struct Side {
    double area;
    int sign;
  };
  static Side side(const Point& u, const Point& v, const Point& q) {
    const bool turned = std::pair(v.x(), v.y()) < std::pair(u.x(), u.y());
    const Point &a = turned ? v : u, &b = turned ? u : v;
    const double area = (b.x() - a.x()) * (q.y() - a.y()) - (b.y() - a.y()) * (q.x() - a.x());
    int sign = (area > 0) - (area < 0);
    if (sign == 0) sign = (a.y() > b.y()) - (a.y() < b.y());
    if (sign == 0) sign = (b.x() > a.x()) - (b.x() < a.x());
    return turned ? Side{-area, -sign} : Side{area, sign};
  }

  void cross(const TriangleMesh& mesh, std::size_t t, const DistanceGrid& grid) {
    const Vec3 corner[3] = {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    const Vec3 low = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
    const Vec3 high = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
    const auto index = [&](const Vec3& p, int axis, double shift) {
      const double at = std::floor((p[axis] - grid.lower()[axis]) / grid.spacing() + shift);
      return static_cast<int>(std::clamp(at, -1.0, DistanceGrid::brick_cells * grid.bricks()[axis] + 1.0));
    };
    const auto last = [&](int axis) { return DistanceGrid::brick_cells * grid.bricks()[axis]; };
    const Point p[3] = {corner[0].head<2>(), corner[1].head<2>(), corner[2].head<2>()};
    for (int x = std::max(0, index(low, 0, -0.5)); x <= std::min(last(0), index(high, 0, 1.5)); ++x)
      for (int y = std::max(0, index(low, 1, -0.5)); y <= std::min(last(1), index(high, 1, 1.5)); ++y) {
        const Point q = grid.node({x, y, 0}).head<2>();
        const Side s[3] = {side(p[1], p[2], q), side(p[2], p[0], q), side(p[0], p[1], q)};
        if (s[0].sign == 0 || s[0].sign != s[1].sign || s[1].sign != s[2].sign) continue;
        const double sum = s[0].area + s[1].area + s[2].area;
        if (sum == 0) continue;  // upright
        const double z = (s[0].area * corner[0].z() + s[1].area * corner[1].z() + s[2].area * corner[2].z()) / sum;
        crossings_.push_back({static_cast<std::uint64_t>(x) * rows_ + static_cast<std::uint64_t>(y), z, s[0].sign});
      }
  }

  std::uint64_t rows_;
  std::vector<Crossing> crossings_;
  std::vector<std::size_t> first_;
};

constexpr double kFar = 1e100;  // m

using TriangleTree = BoundingTree<Triangle>;

std::vector<Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    triangles.push_back({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
  return triangles;
}

/// Distance to the nearest triangle, m, or `limit` if none is nearer.
double distance_to(const TriangleTree& tree, const Vec3& p, double limit) {
  double best = limit * limit;
  tree.visit(SquaredDistanceFrom<double>{p}, best,
             [&](std::uint32_t t) { best = std::min(best, squared_distance(p, tree.items()[t])); });
  return std::sqrt(best);
}

/// Added to all distances, in spacings: a point on the surface counts as free, as with the analytic shapes, whatever
/// the rounding of a float.
constexpr double kLift = 1e-5;

/// All bricks whose middle is so near to the surface that the band may reach into them.
std::vector<Vec3i> bricks_near(const TriangleTree& tree, const DistanceGrid& grid, double band) {
  const Vec3i n = grid.bricks();
  const double reach = band + 0.5 * std::sqrt(3.0) * DistanceGrid::brick_cells * grid.spacing();
  const auto count =
      static_cast<std::size_t>(n.x()) * static_cast<std::size_t>(n.y()) * static_cast<std::size_t>(n.z());
  const auto place = [&](std::size_t k) {
    const int i = static_cast<int>(k / static_cast<std::size_t>(n.y()) / static_cast<std::size_t>(n.z()));
    return Vec3i(i, static_cast<int>(k / static_cast<std::size_t>(n.z()) % static_cast<std::size_t>(n.y())),
                 static_cast<int>(k % static_cast<std::size_t>(n.z())));
  };
  std::vector<std::uint8_t> near(count);
  parallel_for(0, count, 64, [&](std::size_t k) {
    const Vec3i cell = DistanceGrid::brick_cells * place(k) + Vec3i::Constant(DistanceGrid::brick_cells / 2);
    near[k] = distance_to(tree, grid.node(cell), reach * 1.001) < reach;
  });
  std::vector<Vec3i> bricks;
  for (std::size_t k = 0; k < count; ++k)
    if (near[k]) bricks.push_back(place(k));
  return bricks;
}

}  // namespace

std::shared_ptr<const DistanceGrid> sample_distance(const TriangleMesh& mesh, const Vec3& lower, const Vec3& upper,
                                                    double spacing, double band) {
  auto grid = std::make_shared<DistanceGrid>(lower, upper, spacing);
  const TriangleTree tree(triangles_of(mesh));
  const Columns columns(mesh, *grid);
  const auto sign = [&](const Vec3i& node) {
    return columns.winding(node.x(), node.y(), grid->node(node).z()) > 0 ? -1.0 : 1.0;
  };
  const double lift = kLift * spacing;
  const Vec3i n = grid->bricks();
  parallel_for(0, static_cast<std::size_t>(n.x()) + 1, 1, [&](std::size_t x) {
    for (int y = 0; y <= n.y(); ++y)
      for (int z = 0; z <= n.z(); ++z) {
        const Vec3i corner(static_cast<int>(x), y, z), node = DistanceGrid::brick_cells * corner;
        grid->coarse(corner) = static_cast<float>(sign(node) * distance_to(tree, grid->node(node), kFar) + lift);
      }
  });
  const std::vector<Vec3i> bricks = bricks_near(tree, *grid, band);
  grid->refine(bricks);
  parallel_for(0, bricks.size(), 4, [&](std::size_t k) {
    float* values = grid->fine(k);
    double guess = kFar;
    for (int m = 0; m < DistanceGrid::brick_nodes; ++m) {
      const Vec3i node = DistanceGrid::brick_cells * bricks[k] + Vec3i(m / 81, m / 9 % 9, m % 9);
      // No node is further from the surface than its neighbour's distance and the way to it.
      const double far = m % 9 == 0 ? kFar : guess + 1.001 * spacing;
      guess = distance_to(tree, grid->node(node), far);
      values[m] = static_cast<float>(sign(node) * guess + lift);
    }
  });
  return grid;
}

}  // namespace lahar
