#pragma once
// Centre-lines as polylines: even spacing of points on a curve, distances, bounding spheres.
#include <functional>
#include <vector>

#include "core/vector.h"

namespace lahar::barrier {

/// A chain of points; `closed` joins the last to the first.
struct Polyline {
  std::vector<Vec3> points;
  bool closed = false;

  [[nodiscard]] std::size_t segments() const { return points.empty() ? 0 : points.size() - (closed ? 0 : 1); }
  [[nodiscard]] const Vec3& start(std::size_t segment) const { return points[segment]; }
  [[nodiscard]] const Vec3& end(std::size_t segment) const {
    return points[segment + 1 == points.size() ? 0 : segment + 1];
  }
};

/// A curve over the parameter range [0, 1]; a closed one has curve(0) = curve(1).
using Curve = std::function<Vec3(double)>;

/// `points` points on the curve whose neighbours are all the same distance apart (relative spread below 1e-9 for
/// smooth curves). The first point is curve(0); an open polyline also ends at curve(1).
[[nodiscard]] Polyline even_polyline(const Curve& curve, int points, bool closed);

/// Sum of the segment lengths, m.
[[nodiscard]] double length(const Polyline& line);

/// The nearest points of two segments: a0 + s (a1 - a0) and b0 + t (b1 - b0), and the vector from the second to the
/// first.
struct Nearest {
  double s = 0, t = 0;
  Vec3 apart = Vec3::Zero();
};

/// Nearest points of the segments a0-a1 and b0-b1 (Ericson 2005, Real-Time Collision Detection, 5.1.9).
[[nodiscard]] Nearest nearest_points(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1);

/// Shortest distance between two polylines, the second moved by `shift`, m. Distances above `limit` may be returned as
/// `limit`: far segments are skipped.
[[nodiscard]] double distance(const Polyline& a, const Polyline& b, const Vec3& shift, double limit);

/// A sphere around all points: centroid and largest distance from it.
struct BoundingSphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};
[[nodiscard]] BoundingSphere bounding_sphere(const Polyline& line);

}  // namespace lahar::barrier
