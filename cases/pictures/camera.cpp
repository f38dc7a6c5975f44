#include "cases/pictures/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"

namespace lahar::cases {

namespace {

constexpr double kMargin = 1.09;  // free space around a fitted scene

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

Vec3 upward(const Vec3& gravity) { return gravity.norm() > 0 ? Vec3(-gravity.normalized()) : Vec3::UnitZ(); }

// Horizontal direction of +x; of +y if x is vertical.
Vec3 downstream(const Vec3& up) {
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
    const Vec3 level = axis - axis.dot(up) * up;
    if (level.norm() > 0.1) return level.normalized();
  }
  return Vec3::UnitX();
}

Vec3 corner(const ViewBox& box, int n) {
  return {(n & 1) ? box.upper.x() : box.lower.x(), (n & 2) ? box.upper.y() : box.lower.y(),
          (n & 4) ? box.upper.z() : box.lower.z()};
}

// The distance from the centre at which every corner is inside the picture.
double fitting_distance(const ViewBox& box, const Camera& camera, double aspect) {
  const Vec3 forward = (camera.target - camera.eye).normalized();
  const Vec3 right = forward.cross(camera.up).normalized(), up = right.cross(forward);
  const double slope = std::tan(0.5 * radians(camera.field_of_view_deg)) / kMargin;
  double distance = 0;
  for (int n = 0; n < 8; ++n) {
    const Vec3 r = corner(box, n) - camera.target;
    const double across = std::max(std::abs(r.dot(right)) / aspect, std::abs(r.dot(up)));
    distance = std::max(distance, across / slope - r.dot(forward));
  }
  return distance;
}

// Moves the camera sideways so that the picture's content, which perspective makes lopsided, sits in the middle.
void centre_content(const ViewBox& box, Camera& camera) {
  const Projection projection(camera, 2, 2);
  Point lower = projection.pixel(corner(box, 0)), upper = lower;
  for (int n = 1; n < 8; ++n) {
    const Point p = projection.pixel(corner(box, n));
    lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  }
  const Point shift = 0.5F * (lower + upper) - Point(1, 1);
  const double metres = projection.pixel_angle() * (camera.target - camera.eye).norm();
  const Vec3 move = metres * (shift.x() * projection.right() - shift.y() * projection.up()).cast<double>();
  camera.eye += move;
  camera.target += move;
}

}  // namespace

Camera fitted_camera(const ViewBox& box, const Vec3& gravity, const ViewDirection& from, double aspect) {
  const Vec3 up = upward(gravity), flow = downstream(up), left = up.cross(flow);
  const double a = radians(from.azimuth_deg), e = radians(std::clamp(from.elevation_deg, -85.0, 85.0));
  const Vec3 direction = std::cos(e) * (-std::cos(a) * flow - std::sin(a) * left) + std::sin(e) * up;
  Camera camera{box.centre() + direction, box.centre(), up, 30};
  const double size = (box.upper - box.lower).norm();
  const double nearest = size > 0 ? 1e-3 * size : 1e-3;  // the eye must not stand at its target
  // Fitting and centring influence each other a little.
  for (int pass = 0; pass < 4; ++pass) {
    camera.eye = camera.target + std::max(fitting_distance(box, camera, aspect), nearest) * direction;
    if (pass < 3) centre_content(box, camera);
  }
  return camera;
}

Projection::Projection(const Camera& camera, int width, int height)
    : eye_(camera.eye.cast<float>()),
      middle_(0.5F * static_cast<float>(width), 0.5F * static_cast<float>(height)),
      scale_(static_cast<float>(2 * std::tan(0.5 * radians(camera.field_of_view_deg)) / height)) {
  const Vec3 view = camera.target - camera.eye, side = view.cross(camera.up);
  require(view.norm() > 0 && side.norm() > 1e-9 * view.norm() * camera.up.norm(), "Projection: degenerate camera");
  forward_ = view.normalized().cast<float>();
  right_ = side.normalized().cast<float>();
  up_ = side.cross(view).normalized().cast<float>();
}

Ray Projection::ray(const Point& pixel) const {
  const Point p = scale_ * (pixel - middle_);
  return {eye_, (forward_ + p.x() * right_ - p.y() * up_).normalized()};
}

Point Projection::pixel(const Vec3& position) const {
  const Vec3f r = position.cast<float>() - eye_;
  const float depth = std::max(r.dot(forward_), 1e-6F) * scale_;
  return middle_ + Point(r.dot(right_), -r.dot(up_)) / depth;
}

}  // namespace lahar::cases
