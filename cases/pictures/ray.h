#pragma once
// The few geometric types that the picture code shares. Pictures are computed in single precision.
#include <limits>

#include "core/vector.h"

namespace lahar::cases {

using Vec3f = Eigen::Vector3f;

/// A place in a picture, from its upper left corner; pixel (0, 0) has its centre at (0.5, 0.5).
using Point = Eigen::Vector2f;

inline constexpr float kNoHit = std::numeric_limits<float>::infinity();

struct Ray {
  Vec3f origin, direction;  ///< direction has unit length
  [[nodiscard]] Vec3f at(float distance) const { return origin + distance * direction; }
};

/// The part of space that a picture shows, m.
struct ViewBox {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
  [[nodiscard]] Vec3 centre() const { return 0.5 * (lower + upper); }
};

/// Distances along a ray at which it enters and leaves an axis-aligned box; it misses the box if entry > exit.
struct BoxSpan {
  float entry, exit;
};
[[nodiscard]] inline BoxSpan box_span(const Vec3f& lower, const Vec3f& upper, const Ray& ray) {
  const Eigen::Array3f inverse = ray.direction.array().inverse();
  const Eigen::Array3f a = (lower - ray.origin).array() * inverse, b = (upper - ray.origin).array() * inverse;
  return {std::max(0.0F, a.min(b).maxCoeff()), a.max(b).minCoeff()};
}

}  // namespace lahar::cases
