#include "core/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lahar {

double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.squaredNorm();
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.squaredNorm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.squaredNorm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).squaredNorm();
  const double sum = va + vb + vc;
  if (!(sum > 0)) return std::min({ap.squaredNorm(), bp.squaredNorm(), cp.squaredNorm()});  // a needle
  return (ap - vb / sum * ab - vc / sum * ac).squaredNorm();
}

namespace {

constexpr std::uint32_t kLeaf = 4;  // triangles

double squared_distance_to_box(const Vec3& p, const Vec3& lower, const Vec3& upper) {
  return (lower - p).cwiseMax(p - upper).cwiseMax(0).squaredNorm();
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) : mesh_(mesh) {
  std::vector<Vec3> middles;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    order_.push_back(t);
    middles.push_back((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3);
  }
  nodes_.reserve(mesh.triangles.size());
  build(0, static_cast<std::uint32_t>(order_.size()), middles);
}

void TriangleTree::build(std::uint32_t first, std::uint32_t count, const std::vector<Vec3>& middles) {
  const auto at = nodes_.size();
  nodes_.push_back({mesh_.corner(order_[first], 0), mesh_.corner(order_[first], 0), first, count, 0});
  Vec3 low = middles[order_[first]], high = low;
  for (std::uint32_t k = first; k < first + count; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      nodes_[at].lower = nodes_[at].lower.cwiseMin(mesh_.corner(order_[k], c));
      nodes_[at].upper = nodes_[at].upper.cwiseMax(mesh_.corner(order_[k], c));
    }
    low = low.cwiseMin(middles[order_[k]]), high = high.cwiseMax(middles[order_[k]]);
  }
  if (count <= kLeaf) return;
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
                   });
  nodes_[at].count = 0;
  build(first, half, middles);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  build(first + half, count - half, middles);
}

double TriangleTree::distance(const Vec3& p, double limit) const {
  double best = limit * limit;
  std::array<std::uint32_t, 64> stack;  // depth is log2 of the number of triangles
  std::size_t height = 0;
  stack[height++] = 0;
  while (height > 0) {
    const std::uint32_t at = stack[--height];
    const Node& node = nodes_[at];
    if (squared_distance_to_box(p, node.lower, node.upper) >= best) continue;
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
      best = std::min(best, squared_distance(p, mesh_.corner(order_[k], 0), mesh_.corner(order_[k], 1),
                                             mesh_.corner(order_[k], 2)));
    if (node.count > 0) continue;
    const Node &left = nodes_[at + 1], &right = nodes_[node.right];
    const bool left_first =
        squared_distance_to_box(p, left.lower, left.upper) < squared_distance_to_box(p, right.lower, right.upper);
    stack[height++] = left_first ? node.right : at + 1;
    stack[height++] = left_first ? at + 1 : node.right;
  }
  return std::sqrt(best);
}

}  // namespace lahar
