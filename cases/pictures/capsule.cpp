#include "cases/pictures/capsule.h"

#include <algorithm>
#include <cmath>

namespace lahar::cases {

namespace {

// Smallest distance >= 0 with |origin + t direction - centre| = radius, coming from outside.
float sphere_entry(const Vec3f& centre, float radius, const Ray& ray) {
  const Vec3f to_centre = centre - ray.origin;
  const float along = to_centre.dot(ray.direction);
  const float miss2 = (to_centre - along * ray.direction).squaredNorm();
  const float half2 = radius * radius - miss2;
  if (half2 < 0) return kNoHit;
  const float entry = along - std::sqrt(half2);
  return entry >= 0 ? entry : kNoHit;
}

}  // namespace

float capsule_entry(const Capsule& capsule, const Ray& ray) {
  const Vec3f axis = capsule.end - capsule.start;
  const float length2 = axis.squaredNorm();
  if (length2 == 0) return sphere_entry(capsule.start, capsule.radius, ray);
  // The infinite cylinder, in components normal to the axis (scaled by length^2 to save divisions).
  const Vec3f r = ray.origin - capsule.start;
  const float ad = axis.dot(ray.direction), ar = axis.dot(r);
  const float a = length2 - ad * ad;
  const float b = length2 * r.dot(ray.direction) - ar * ad;
  const float c = length2 * (r.squaredNorm() - capsule.radius * capsule.radius) - ar * ar;
  const float discriminant = b * b - a * c;
  if (discriminant < 0) return kNoHit;
  float nearest_end = ad < 0 ? length2 : 0;
  if (a > 0) {
    const float t = (-b - std::sqrt(discriminant)) / a;
    const float along = ar + t * ad;
    if (along > 0 && along < length2) return t >= 0 ? t : kNoHit;
    nearest_end = along;
  }
  return sphere_entry(nearest_end <= 0 ? capsule.start : capsule.end, capsule.radius, ray);
}

Vec3f capsule_normal(const Capsule& capsule, const Vec3f& point) {
  const Vec3f axis = capsule.end - capsule.start;
  const float length2 = axis.squaredNorm();
  const float along = length2 > 0 ? std::clamp((point - capsule.start).dot(axis) / length2, 0.0F, 1.0F) : 0.0F;
  return (point - capsule.start - along * axis).normalized();
}

CapsuleHit nearest_capsule(const CapsuleTree& tree, const Ray& ray, float limit) {
  CapsuleHit hit;
  tree.visit(EntryOfRay<float>(ray.origin, ray.direction), limit, [&](std::uint32_t i) {
    const float distance = capsule_entry(tree.items()[i], ray);
    if (distance < limit) limit = distance, hit = {distance, static_cast<std::int32_t>(i)};
  });
  return hit;
}

bool blocked(const CapsuleTree& tree, const Ray& ray, float limit) {
  bool hit = false;
  tree.visit(EntryOfRay<float>(ray.origin, ray.direction), limit, [&](std::uint32_t i) {
    if (capsule_entry(tree.items()[i], ray) < limit) hit = true, limit = -1;
  });
  return hit;
}

}  // namespace lahar::cases
