#include "core/geometry.h"

#include <algorithm>

namespace lahar {

namespace {

Vec3 normalized_or_up(const Vec3& v) {
  const double n = v.norm();
  return n > 0 ? Vec3(v / n) : Vec3::UnitZ();
}

}  // namespace

double SolidBox::distance(const Vec3& p) const {
  const Vec3 q = (p - 0.5 * (lower + upper)).cwiseAbs() - 0.5 * (upper - lower);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

Vec3 SolidBox::gradient(const Vec3& p) const {
  const Vec3 r = p - 0.5 * (lower + upper);
  const Vec3 q = r.cwiseAbs() - 0.5 * (upper - lower);
  const Vec3 sign(r.x() < 0 ? -1 : 1, r.y() < 0 ? -1 : 1, r.z() < 0 ? -1 : 1);
  if (q.maxCoeff() > 0) return normalized_or_up(q.cwiseMax(0).cwiseProduct(sign));
  Eigen::Index axis = 0;
  q.maxCoeff(&axis);
  Vec3 g = Vec3::Zero();
  g[axis] = sign[axis];
  return g;
}

namespace {

/// Distance to a capped cylinder in the half-plane through its axis: q = (radial - radius, |axial| - half length).
struct CylinderFrame {
  Vec3 axis, radial;
  double q_radial, q_axial, side;
};

CylinderFrame cylinder_frame(const SolidCylinder& c, const Vec3& p) {
  const Vec3 axis = (c.end - c.start).normalized();
  const Vec3 r = p - 0.5 * (c.start + c.end);
  const double along = r.dot(axis);
  const Vec3 off = r - along * axis;
  return {axis, normalized_or_up(off), off.norm() - c.radius, std::abs(along) - 0.5 * (c.end - c.start).norm(),
          along < 0 ? -1.0 : 1.0};
}

}  // namespace

double SolidCylinder::distance(const Vec3& p) const {
  const auto f = cylinder_frame(*this, p);
  if (hollow) return -f.q_radial;
  return std::hypot(std::max(f.q_radial, 0.0), std::max(f.q_axial, 0.0)) +
         std::min(std::max(f.q_radial, f.q_axial), 0.0);
}

Vec3 SolidCylinder::gradient(const Vec3& p) const {
  const auto f = cylinder_frame(*this, p);
  if (hollow) return -f.radial;
  if (f.q_radial > 0 && f.q_axial > 0) return normalized_or_up(f.q_radial * f.radial + f.q_axial * f.side * f.axis);
  return f.q_radial > f.q_axial ? f.radial : Vec3(f.side * f.axis);
}

Vec3 SolidSphere::gradient(const Vec3& p) const { return normalized_or_up(p - centre); }

bool Walls::open_by(double time) {
  bool some = false;
  for (Wall& wall : walls_)
    if (!wall.open && wall.opens_at <= time) some = wall.open = true;
  return some;
}

void Walls::transfer(Archive& archive) {
  std::vector<std::uint8_t> open;
  for (const Wall& wall : walls_) open.push_back(wall.open ? 1 : 0);
  archive.list_of("open", open, walls_.size());
  for (std::size_t w = 0; w < walls_.size(); ++w) walls_[w].open = open[w] != 0;
}

double Walls::distance(std::size_t wall, const Vec3& p) const {
  if (walls_[wall].open) return std::numeric_limits<double>::infinity();
  return std::visit([&](const auto& s) { return s.distance(p); }, walls_[wall].shape);
}

Vec3 Walls::gradient(std::size_t wall, const Vec3& p) const {
  return std::visit([&](const auto& s) { return Vec3(s.gradient(p)); }, walls_[wall].shape);
}

WallPoint Walls::nearest(const Vec3& p, double slack) const {
  WallPoint best;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const double d = distance(w, p);
    if (d < best.distance - (best.wall < 0 ? 0.0 : slack)) {
      best.distance = d;
      best.wall = static_cast<int>(w);
    }
  }
  if (best.wall >= 0) best.normal = gradient(static_cast<std::size_t>(best.wall), p);
  return best;
}

}  // namespace lahar
