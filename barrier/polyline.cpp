#include "barrier/polyline.h"

#include <algorithm>

namespace lahar::barrier {

namespace {

/// Cumulated chord lengths of the points at `parameters` (first entry 0).
std::vector<double> cumulated_chords(const Curve& curve, const std::vector<double>& parameters) {
  std::vector<double> sum{0.0};
  Vec3 previous = curve(parameters.front());
  for (std::size_t k = 1; k < parameters.size(); ++k) {
    const Vec3 next = curve(parameters[k]);
    sum.push_back(sum.back() + (next - previous).norm());
    previous = next;
  }
  return sum;
}

/// Moves the inner parameters to where equal shares of the chord length lie, by linear interpolation. Returns the
/// largest move.
double even_out(const std::vector<double>& chords, std::vector<double>& parameters) {
  const std::vector<double> old = parameters;
  const std::size_t n = old.size() - 1;
  double largest = 0;
  for (std::size_t k = 1, s = 0; k < n; ++k) {
    const double wanted = chords.back() * static_cast<double>(k) / static_cast<double>(n);
    while (chords[s + 1] < wanted) ++s;
    parameters[k] = old[s] + (old[s + 1] - old[s]) * (wanted - chords[s]) / (chords[s + 1] - chords[s]);
    largest = std::max(largest, std::abs(parameters[k] - old[k]));
  }
  return largest;
}

}  // namespace

Polyline even_polyline(const Curve& curve, int points, bool closed) {
  const int segments = closed ? points : points - 1;
  std::vector<double> parameters;
  for (int k = 0; k <= segments; ++k) parameters.push_back(static_cast<double>(k) / segments);
  for (int pass = 0; pass < 200; ++pass)
    if (even_out(cumulated_chords(curve, parameters), parameters) < 1e-9) break;
  Polyline line;
  line.closed = closed;
  for (int k = 0; k < points; ++k) line.points.push_back(curve(parameters[static_cast<std::size_t>(k)]));
  return line;
}

double length(const Polyline& line) {
  double sum = 0;
  for (std::size_t s = 0; s < line.segments(); ++s) sum += (line.end(s) - line.start(s)).norm();
  return sum;
}

Nearest nearest_points(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const Vec3 u = a1 - a0, v = b1 - b0, w = a0 - b0;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double denominator = uu * vv - uv * uv;  // 0 for parallel segments: any s will do, t follows
  double s = denominator > 1e-14 * uu * vv ? std::clamp((uv * vw - vv * uw) / denominator, 0.0, 1.0) : 0.0;
  double t = (uv * s + vw) / vv;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
  }
  return {s, t, w + s * u - t * v};
}

double distance(const Polyline& a, const Polyline& b, const Vec3& shift, double limit) {
  double best = limit;
  for (std::size_t i = 0; i < a.segments(); ++i) {
    const Vec3 a0 = a.start(i) - shift, a1 = a.end(i) - shift;
    const double half_a = 0.5 * (a1 - a0).norm();
    for (std::size_t j = 0; j < b.segments(); ++j) {
      const double reach = best + half_a + 0.5 * (b.end(j) - b.start(j)).norm();
      if (0.25 * (a0 + a1 - b.start(j) - b.end(j)).squaredNorm() > reach * reach) continue;
      best = std::min(best, nearest_points(a0, a1, b.start(j), b.end(j)).apart.norm());
    }
  }
  return best;
}

BoundingSphere bounding_sphere(const Polyline& line) {
  BoundingSphere sphere;
  for (const Vec3& p : line.points) sphere.centre += p / static_cast<double>(line.points.size());
  for (const Vec3& p : line.points) sphere.radius = std::max(sphere.radius, (p - sphere.centre).norm());
  return sphere;
}

}  // namespace lahar::barrier
