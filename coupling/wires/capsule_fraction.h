#pragma once
// How much of a cell a capsule (all points within a radius of a segment) covers; see sphere_fraction.h. For a straight
// cylinder eps = clamp(1/2 - d, 0, 1) has the cross-section pi (r'^2 + 1/12) for r' >= 1/2, which gives r' from the
// radius; the round ends then have the volume of a sphere to 1 / (12 r^2) of itself.
#include <algorithm>
#include <cmath>

#include "core/vector.h"

namespace lahar::coupling {

/// Radius of the mapping: at least 1/2; thinner capsules cover too much and are left to the wires' drag law.
inline double capsule_mapping_radius(double r) { return std::max(0.5, std::sqrt(std::max(0.0, r * r - 1.0 / 12))); }

/// Distance of a point from the segment a-b.
inline double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

/// eps of a cell by its centre, all in cells.
inline double capsule_fraction(const Vec3& centre, const Vec3& a, const Vec3& b, double mapping_radius) {
  return std::clamp(0.5 + mapping_radius - segment_distance(centre, a, b), 0.0, 1.0);
}

}  // namespace lahar::coupling
