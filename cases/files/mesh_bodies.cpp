#include "cases/files/mesh_bodies.h"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

namespace lahar::cases {

namespace {

/// The part of all directions from the origin that a triangle takes, > 0 where it looks away from there (Van Oosterom
/// and Strackee 1983, IEEE Trans. Biomed. Eng. 30, 125-126).
double share_of_directions(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double along = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return std::atan2(a.dot(b.cross(c)), along) / (2 * std::numbers::pi);
}

/// How often a closed mesh goes round a point off its surface.
double winding_number(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sum += share_of_directions(mesh.corner(t, 0) - p, mesh.corner(t, 1) - p, mesh.corner(t, 2) - p);
  return sum;
}

/// A point at a small distance within a mesh whose faces look inwards, before the middle of its largest face. m.
Vec3 point_within(const TriangleMesh& mesh, double distance) {
  Vec3 point = Vec3::Zero(), largest = Vec3::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    const Vec3 area = (b - a).cross(c - a);
    if (area.squaredNorm() > largest.squaredNorm()) largest = area, point = (a + b + c) / 3;
  }
  return point + distance * largest.normalized();
}

}  // namespace

std::vector<TriangleMesh> bodies_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  for (const auto& t : mesh.triangles)
    for (const std::size_t k : {1, 2}) parent[root(t[k])] = root(t[0]);
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(mesh.points.size(), none);
  std::map<std::uint32_t, std::size_t> number;  // of a body, by its root
  std::vector<TriangleMesh> bodies;
  for (const auto& t : mesh.triangles) {
    const auto [found, is_new] = number.try_emplace(root(t[0]), bodies.size());
    if (is_new) bodies.emplace_back();
    TriangleMesh& body = bodies[found->second];
    for (const std::uint32_t corner : t) {
      if (place[corner] != none) continue;
      place[corner] = static_cast<std::uint32_t>(body.points.size());
      body.points.push_back(mesh.points[corner]);
    }
    body.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  }
  return bodies;
}

std::optional<Bounds> body_inside_out(const TriangleMesh& mesh) {
  const std::vector<TriangleMesh> bodies = bodies_of(mesh);
  std::vector<Bounds> bounds;
  for (const TriangleMesh& body : bodies) bounds.push_back(bounds_of(body));
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const double size = (bounds[k].upper - bounds[k].lower).norm();
    constexpr double rounding = 1e-12;  // of the cube of the size: two faces back to back enclose nothing
    if (!(signed_volume(bodies[k]) < -rounding * std::pow(size, 3))) continue;
    const Vec3 p = point_within(bodies[k], 1e-6 * size);
    double around = 0;
    for (std::size_t n = 0; n < bodies.size(); ++n)
      if (n != k && (p.array() >= bounds[n].lower.array()).all() && (p.array() <= bounds[n].upper.array()).all())
        around += winding_number(bodies[n], p);
    if (around < 0.5) return bounds[k];
  }
  return std::nullopt;
}

}  // namespace lahar::cases
