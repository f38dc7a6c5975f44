#pragma once
// Grains and wires as spheres and capsules, in a bounding volume hierarchy for fast ray queries. (A uniform grid would
// suffer from the 13-fold range of sizes.)
#include <cstdint>
#include <vector>

#include "cases/pictures/ray.h"

namespace lahar::cases {

/// All points within `radius` of a segment; a sphere if both ends coincide.
struct Capsule {
  Vec3f start, end;
  float radius = 0;
};

struct CapsuleHit {
  float distance = kNoHit;
  std::int32_t capsule = -1;  ///< index, -1 if nothing was hit
};

/// Distance along the ray at which it enters a capsule from outside, kNoHit if it misses.
[[nodiscard]] float capsule_entry(const Capsule& capsule, const Ray& ray);

/// Outward unit normal at a point of the surface.
[[nodiscard]] Vec3f capsule_normal(const Capsule& capsule, const Vec3f& point);

class CapsuleTree {
 public:
  explicit CapsuleTree(std::vector<Capsule> capsules);
  /// The nearest hit closer than `limit`.
  [[nodiscard]] CapsuleHit nearest(const Ray& ray, float limit = kNoHit) const;
  /// Whether anything is hit closer than `limit`.
  [[nodiscard]] bool blocked(const Ray& ray, float limit = kNoHit) const;
  [[nodiscard]] const std::vector<Capsule>& capsules() const { return capsules_; }

 private:
  struct Node {
    Vec3f lower = Vec3f::Zero(), upper = Vec3f::Zero();
    std::uint32_t first = 0;  // of the capsules in order_ (leaf), else the left child; the right one follows it
    std::uint32_t count = 0;  // 0 for an inner node
  };
  void build(const std::vector<Vec3f>& centres);
  void set_bounds(Node& node) const;
  [[nodiscard]] std::uint32_t split(const Node& node, const std::vector<Vec3f>& centres);
  template <class Visit>
  void visit_leaves(const Ray& ray, float& limit, const Visit& visit) const;

  std::vector<Capsule> capsules_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace lahar::cases
