#include "barrier/linking.h"

#include <cmath>
#include <numbers>

#include "core/check.h"

namespace lahar::barrier {

namespace {

/// A direction from the first curve to the second, with its length.
struct Ray {
  Vec3 r;
  double length;
  Ray(const Vec3& from, const Vec3& to) : r(to - from), length(r.norm()) {}
};

/// Half the signed area that three rays cut out of the unit sphere.
double half_solid_angle(const Ray& a, const Ray& b, const Ray& c) {
  const double volume = a.r.dot(b.r.cross(c.r));
  const double base =
      a.length * b.length * c.length + a.r.dot(b.r) * c.length + a.r.dot(c.r) * b.length + b.r.dot(c.r) * a.length;
  return std::atan2(volume, base);
}

}  // namespace

double linking_number(const Polyline& a, const Polyline& b) {
  require(a.closed && b.closed, "the linking number needs closed curves");
  double half_area = 0;
  for (std::size_t i = 0; i < a.segments(); ++i) {
    Ray near(a.start(i), b.start(0)), far(a.end(i), b.start(0));
    for (std::size_t j = 0; j < b.segments(); ++j) {
      const Ray next_near(a.start(i), b.end(j)), next_far(a.end(i), b.end(j));
      half_area += half_solid_angle(near, far, next_far) + half_solid_angle(near, next_far, next_near);
      near = next_near, far = next_far;
    }
  }
  return half_area / (2 * std::numbers::pi);
}

int links(const Polyline& a, const Polyline& b) {
  const double number = linking_number(a, b);
  require(std::abs(number - std::round(number)) < 1e-3, "linking number of curves that touch");
  return static_cast<int>(std::lround(number));
}

Polyline closed_far_away(const Polyline& thread, double reach, const Vec3& around) {
  const Vec3 first = thread.points.front(), last = thread.points.back();
  const Vec3 along = (last - first).normalized();
  const Vec3 aside = reach * (around - around.dot(along) * along).normalized();
  Polyline loop{thread.points, true};
  loop.points.push_back(last + reach * along);
  loop.points.push_back(last + reach * along + aside);
  loop.points.push_back(first - reach * along + aside);
  loop.points.push_back(first - reach * along);
  return loop;
}

int links_with_thread(const Polyline& ring, const Polyline& thread) {
  const BoundingSphere r = bounding_sphere(ring), t = bounding_sphere(thread);
  const double reach = 10 * ((r.centre - t.centre).norm() + r.radius + t.radius);
  return links(ring, closed_far_away(thread, reach, (thread.points.back() - thread.points.front()).unitOrthogonal()));
}

}  // namespace lahar::barrier
