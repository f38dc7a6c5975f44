#include "cases/pictures/backdrop.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lahar::cases {

namespace {

constexpr int kMarchSteps = 64;

ViewBox bounds_of(const SolidBox& b) { return {b.lower, b.upper}; }
ViewBox bounds_of(const SampledDistance& s) { return {s.grid->lower(), s.grid->upper()}; }
ViewBox bounds_of(const SolidSphere& s) {
  return {s.centre - Vec3::Constant(s.radius), s.centre + Vec3::Constant(s.radius)};
}
ViewBox bounds_of(const SolidCylinder& c) {
  return {c.start.cwiseMin(c.end) - Vec3::Constant(c.radius), c.start.cwiseMax(c.end) + Vec3::Constant(c.radius)};
}

/// Outwards from the face at which a ray enters a box.
Vec3f face_entered(const Vec3f& lower, const Vec3f& upper, const Ray& ray) {
  const Eigen::Array3f inverse = ray.direction.array().inverse();
  const Eigen::Array3f a = (lower - ray.origin).array() * inverse, b = (upper - ray.origin).array() * inverse;
  int axis = 0;
  a.min(b).maxCoeff(&axis);
  return ray.direction[axis] > 0 ? Vec3f(-Vec3f::Unit(axis)) : Vec3f(Vec3f::Unit(axis));
}

}  // namespace

Backdrop::Backdrop(const Walls& walls, const ViewBox& box, const Vec3& eye)
    : walls_(walls), lower_(box.lower.cast<float>()), upper_(box.upper.cast<float>()) {
  for (std::size_t w = 0; w < walls.all().size(); ++w) {
    if (walls.all()[w].open) continue;
    const int index = static_cast<int>(w);
    const Shape& shape = walls.all()[w].shape;
    if (const auto* plane = std::get_if<HalfSpace>(&shape)) {
      if (plane->distance(eye) > 0)
        planes_.push_back({plane->point.cast<float>(), plane->normal.normalized().cast<float>(), index});
      continue;
    }
    std::visit(
        [&](const auto& solid) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(solid)>, HalfSpace>) {
            const ViewBox bounds = bounds_of(solid);
            solids_.push_back(
                {bounds.lower.cast<float>().cwiseMax(lower_), bounds.upper.cast<float>().cwiseMin(upper_), index});
          }
        },
        shape);
  }
}

float Backdrop::plane_distance(const Plane& plane, const Ray& ray) const {
  const float slope = ray.direction.dot(plane.normal);
  if (slope >= 0) return kNoHit;
  const float t = (plane.point - ray.origin).dot(plane.normal) / slope;
  if (t <= 0) return kNoHit;
  const Vec3f p = ray.at(t);
  const float slack = 1e-3F * (upper_ - lower_).norm();  // a wall may lie just outside the box
  const bool inside = ((p - lower_).array() >= -slack).all() && ((upper_ - p).array() >= -slack).all();
  return inside ? t : kNoHit;
}

// Steps along the ray by the signed distance, which never oversteps a solid.
float Backdrop::solid_distance(const Solid& solid, const Ray& ray, float limit) const {
  const BoxSpan span = box_span(solid.lower, solid.upper, ray);
  if (!(span.entry <= std::min(span.exit, limit))) return kNoHit;
  const float tolerance = 1e-4F * (upper_ - lower_).norm();
  float t = span.entry;
  for (int step = 0; step < kMarchSteps && t <= std::min(span.exit, limit) + tolerance; ++step) {
    const auto d = static_cast<float>(walls_.distance(static_cast<std::size_t>(solid.wall), ray.at(t).cast<double>()));
    if (d < tolerance) return t;
    t += d;
  }
  return kNoHit;
}

BackdropHit Backdrop::nearest(const Ray& ray, float limit) const {
  BackdropHit hit;
  hit.distance = limit;
  for (const Plane& plane : planes_) {
    const float t = plane_distance(plane, ray);
    if (t < hit.distance) hit = {t, plane.normal, plane.wall, true};
  }
  for (const Solid& solid : solids_) {
    const float t = solid_distance(solid, ray, hit.distance);
    if (!(t < hit.distance)) continue;
    // Where the view box cuts a solid, the cut is seen.
    const auto wall = static_cast<std::size_t>(solid.wall);
    const Vec3 at = ray.at(t).cast<double>();
    const bool cut = walls_.distance(wall, at) < -1e-4 * static_cast<double>((upper_ - lower_).norm());
    const Vec3f normal =
        cut ? face_entered(solid.lower, solid.upper, ray) : Vec3f(walls_.gradient(wall, at).cast<float>());
    hit = {t, normal, solid.wall, false};
  }
  if (hit.wall < 0) hit.distance = kNoHit;
  return hit;
}

bool Backdrop::blocked(const Ray& ray) const {
  return std::any_of(solids_.begin(), solids_.end(),
                     [&](const Solid& solid) { return solid_distance(solid, ray, kNoHit) < kNoHit; });
}

float grid_line_share(const Vec3f& position, const Vec3f& normal, float spacing, float width, float footprint) {
  float share = 0;
  for (int d = 0; d < 3; ++d) {
    const float along = std::sqrt(std::max(0.0F, 1 - normal[d] * normal[d]));  // distance on the wall per metre of d
    if (along < 0.5F) continue;                                                // the coordinate across the wall
    const float off = std::abs(position[d] / spacing - std::round(position[d] / spacing)) * spacing / along;
    // Lines thinner than a pixel are widened to a pixel and made fainter by the same factor.
    const float shown = std::max(width, footprint);
    const float edge = std::clamp((0.5F * shown - off) / footprint + 0.5F, 0.0F, 1.0F);
    share = std::max(share, edge * width / shown);
  }
  return share;
}

float round_spacing(double length, int lines) {
  const double rough = std::max(length, 1e-9) / lines;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (rough <= factor * power * 1.0001) return static_cast<float>(factor * power);
  return static_cast<float>(10 * power);
}

}  // namespace lahar::cases
