#pragma once
// One triangle in space.
#include <Eigen/Geometry>

#include "core/vector.h"

namespace lahar {

struct Triangle {
  Vec3 a, b, c;  ///< corners
};

/// Square of the distance from a point to a triangle (Ericson 2005, Real-Time Collision Detection, 5.1.5).
double squared_distance(const Vec3& p, const Triangle& triangle);

inline Eigen::AlignedBox3d bounding_box(const Triangle& t) {
  return {t.a.cwiseMin(t.b).cwiseMin(t.c), t.a.cwiseMax(t.b).cwiseMax(t.c)};
}

}  // namespace lahar
