#pragma once
// The walls of a scene as surfaces in a picture: flat walls cut to the view box, solid bodies as they are.
#include <vector>

#include "cases/pictures/ray.h"
#include "core/geometry.h"

namespace lahar::cases {

struct BackdropHit {
  float distance = kNoHit;
  Vec3f normal = Vec3f::Zero();  ///< towards the side that the ray comes from
  int wall = -1;                 ///< index into Walls::all(), -1 if nothing was hit
  bool flat = false;             ///< a half-space (gets a grid), not a solid body
};

class Backdrop {
 public:
  /// Flat walls that the camera looks at from behind are left out, as if they were glass. `walls` must outlive this.
  Backdrop(const Walls& walls, const ViewBox& box, const Vec3& eye);
  [[nodiscard]] BackdropHit nearest(const Ray& ray, float limit) const;
  /// Whether a solid body stands in the way; flat walls let light in.
  [[nodiscard]] bool blocked(const Ray& ray) const;

 private:
  struct Plane {
    Vec3f point, normal;
    int wall;
  };
  struct Solid {
    Vec3f lower, upper;
    int wall;
  };
  [[nodiscard]] float plane_distance(const Plane& plane, const Ray& ray) const;
  [[nodiscard]] float solid_distance(const Solid& solid, const Ray& ray, float limit) const;

  const Walls& walls_;
  Vec3f lower_, upper_;
  std::vector<Plane> planes_;
  std::vector<Solid> solids_;
};

/// How much of a pixel lies on the lines of a square grid drawn on a flat wall: 0 none, 1 all. `footprint` is the size
/// of a pixel on the wall, m; lines are `width` wide, m.
[[nodiscard]] float grid_line_share(const Vec3f& position, const Vec3f& normal, float spacing, float width,
                                    float footprint);

/// A round spacing (1, 2 or 5 times a power of ten) of which about `lines` fit into `length`.
[[nodiscard]] float round_spacing(double length, int lines);

}  // namespace lahar::cases
