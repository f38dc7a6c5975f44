#pragma once
// Grains and wires as spheres and capsules, and what a ray meets of them. (In a tree of boxes: a uniform grid would
// suffer from the 13-fold range of sizes.)
#include <cstdint>

#include "cases/pictures/ray.h"
#include "core/bounding_tree.h"

namespace lahar::cases {

/// All points within `radius` of a segment; a sphere if both ends coincide.
struct Capsule {
  Vec3f start, end;
  float radius = 0;
};

[[nodiscard]] inline Eigen::AlignedBox3f bounding_box(const Capsule& c) {
  const Vec3f rim = Vec3f::Constant(c.radius);
  return {c.start.cwiseMin(c.end) - rim, c.start.cwiseMax(c.end) + rim};
}

/// Distance along the ray at which it enters a capsule from outside, kNoHit if it misses.
[[nodiscard]] float capsule_entry(const Capsule& capsule, const Ray& ray);

/// Outward unit normal at a point of the surface.
[[nodiscard]] Vec3f capsule_normal(const Capsule& capsule, const Vec3f& point);

using CapsuleTree = BoundingTree<Capsule>;

struct CapsuleHit {
  float distance = kNoHit;
  std::int32_t capsule = -1;  ///< index, -1 if nothing was hit
};

/// The nearest hit closer than `limit`.
[[nodiscard]] CapsuleHit nearest_capsule(const CapsuleTree& tree, const Ray& ray, float limit = kNoHit);

/// Whether anything is hit closer than `limit`.
[[nodiscard]] bool blocked(const CapsuleTree& tree, const Ray& ray, float limit = kNoHit);

}  // namespace lahar::cases
