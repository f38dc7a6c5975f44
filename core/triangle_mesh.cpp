#include "core/triangle_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

namespace lahar {

void weld(TriangleMesh& mesh) {
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::vector<std::uint32_t> order(mesh.points.size()), place(mesh.points.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
  for (Vec3& p : mesh.points) p += Vec3::Zero();  // -0 becomes 0
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (before(mesh.points[a], mesh.points[b])) return true;
    return !before(mesh.points[b], mesh.points[a]) && a < b;
  });
  std::vector<Vec3> points;
  for (const std::uint32_t k : order) {
    if (points.empty() || points.back() != mesh.points[k]) points.push_back(mesh.points[k]);
    place[k] = static_cast<std::uint32_t>(points.size() - 1);
  }
  mesh.points = std::move(points);
  std::erase_if(mesh.triangles, [&](std::array<std::uint32_t, 3>& t) {
    for (std::uint32_t& corner : t) corner = place[corner];
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
}

std::size_t open_edges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return static_cast<std::size_t>(
      std::count_if(balance.begin(), balance.end(), [](const auto& edge) { return edge.second != 0; }));
}

double signed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  if (mesh.points.empty()) return volume;
  const Vec3 origin = mesh.points.front();  // near the mesh: far from it the parts would cancel badly
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    volume += (mesh.corner(t, 0) - origin).dot((mesh.corner(t, 1) - origin).cross(mesh.corner(t, 2) - origin)) / 6;
  return volume;
}

void flip(TriangleMesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

Bounds bounds_of(const TriangleMesh& mesh) {
  Bounds b{mesh.points.front(), mesh.points.front()};
  for (const Vec3& p : mesh.points) b.lower = b.lower.cwiseMin(p), b.upper = b.upper.cwiseMax(p);
  return b;
}

}  // namespace lahar
