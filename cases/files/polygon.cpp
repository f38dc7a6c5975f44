#include "cases/files/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/triangle.h"

namespace lahar::cases {

namespace {

using Corners = std::vector<std::uint32_t>;
using Indices = std::array<std::uint32_t, 3>;

constexpr double kFlat = 1e-6;               // of the longest edge: a height that counts as none
constexpr std::size_t kMostCorners = 10000;  // ears take a time that grows with the square of these

/// Normal, twice as long as the area, m^2.
Vec3 area_vector(const Triangle& t) { return (t.b - t.a).cross(t.c - t.a); }

/// Twice the area below which a triangle is flat, m^2.
double flat_area(const Triangle& t) {
  return kFlat * std::max({(t.b - t.a).squaredNorm(), (t.c - t.b).squaredNorm(), (t.a - t.c).squaredNorm()});
}

/// Cuts a face corner by corner (ears; Meisters 1975, Am. Math. Monthly 82, 648-651). Triangles that all look along the
/// normal of the face cover each point as often as its outline goes round it: none outside.
class EarCutter {
 public:
  EarCutter(const TriangleMesh& mesh, Corners corners, Vec3 normal)
      : mesh_(mesh), left_(std::move(corners)), normal_(std::move(normal)) {
    for (std::size_t k = 0; k < left_.size(); ++k) ears_.push_back(is_ear(k));
  }

  /// None if it cannot be done.
  std::vector<Indices> cut() {
    std::vector<Indices> triangles;
    while (left_.size() >= 3) {
      const std::size_t k = next_corner();
      if (k == left_.size()) return {};
      triangles.push_back({left_[before(k)], left_[k], left_[after(k)]});
      take_off(k);
    }
    return triangles;
  }

 private:
  [[nodiscard]] std::size_t before(std::size_t k) const { return (k == 0 ? left_.size() : k) - 1; }
  [[nodiscard]] std::size_t after(std::size_t k) const { return k + 1 == left_.size() ? 0 : k + 1; }
  [[nodiscard]] const Vec3& point(std::size_t k) const { return mesh_.points[left_[k]]; }
  [[nodiscard]] Triangle corner(std::size_t k) const { return {point(before(k)), point(k), point(after(k))}; }
  /// Twice the area as seen along the normal, > 0 if anticlockwise.
  [[nodiscard]] double turn(const Triangle& t) const { return area_vector(t).dot(normal_); }

  /// A triangle within what is left, with no other corner inside or on the cut.
  [[nodiscard]] bool is_ear(std::size_t k) const {
    const Triangle t = corner(k);
    if (!(turn(t) > flat_area(t))) return false;
    const double ab = (t.b - t.a).norm(), bc = (t.c - t.b).norm(), ca = (t.a - t.c).norm();
    const double height = kFlat * std::max({ab, bc, ca});
    return std::none_of(left_.begin(), left_.end(), [&](std::uint32_t other) {
      const Vec3& p = mesh_.points[other];
      return turn({t.a, t.b, p}) > height * ab && turn({t.b, t.c, p}) > height * bc &&
             turn({t.c, t.a, p}) >= -height * ca;
    });
  }
  /// An ear, or else a corner on the line between its neighbours; the number of corners where there is neither.
  [[nodiscard]] std::size_t next_corner() const {
    const auto ear = static_cast<std::size_t>(std::find(ears_.begin(), ears_.end(), true) - ears_.begin());
    if (ear < left_.size()) return ear;
    std::size_t k = 0;
    while (k < left_.size() && !(std::abs(turn(corner(k))) <= flat_area(corner(k)))) ++k;
    return k;
  }
  /// Only its neighbours can become ears by this, or cease to be.
  void take_off(std::size_t k) {
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(k));
    ears_.erase(ears_.begin() + static_cast<std::ptrdiff_t>(k));
    if (left_.size() < 3) return;
    const std::size_t next = k == left_.size() ? 0 : k;
    for (const std::size_t neighbour : {before(next), next}) ears_[neighbour] = is_ear(neighbour);
  }

  const TriangleMesh& mesh_;
  Corners left_;
  Vec3 normal_;
  std::vector<bool> ears_;
};

}  // namespace

bool add_face(TriangleMesh& mesh, const Corners& corners) {
  std::vector<Indices> triangles;
  for (std::size_t k = 2; k < corners.size(); ++k) triangles.push_back({corners[0], corners[k - 1], corners[k]});
  const auto triangle = [&](const Indices& t) {
    return Triangle{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
  };
  Vec3 normal = Vec3::Zero();
  double sum = 0;
  for (const Indices& t : triangles) normal += area_vector(triangle(t)), sum += area_vector(triangle(t)).norm();
  const bool on_a_line = std::all_of(triangles.begin(), triangles.end(), [&](const Indices& t) {
    return area_vector(triangle(t)).norm() <= flat_area(triangle(t));
  });
  if (triangles.size() > 1 && !on_a_line) {
    if (!(normal.norm() > kFlat * sum)) return false;  // parts that look opposite ways
    normal.normalize();
    const bool covered = std::all_of(triangles.begin(), triangles.end(), [&](const Indices& t) {
      return area_vector(triangle(t)).dot(normal) >= -flat_area(triangle(t));
    });
    if (!covered && corners.size() > kMostCorners) return false;
    if (!covered) triangles = EarCutter(mesh, corners, normal).cut();
  }
  mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
  return corners.size() < 3 || !triangles.empty();
}

}  // namespace lahar::cases
