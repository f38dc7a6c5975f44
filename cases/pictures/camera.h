#pragma once
// A perspective camera.
#include "cases/pictures/ray.h"

namespace lahar::cases {

struct Camera {
  Vec3 eye = Vec3::Zero();        ///< m
  Vec3 target = Vec3::UnitX();    ///< the point in the middle of the picture, m
  Vec3 up = Vec3::UnitZ();        ///< direction that points up in the picture
  double field_of_view_deg = 30;  ///< from the lower to the upper edge
};

/// From where a scene is looked at, in the true frame where gravity points down.
struct ViewDirection {
  double azimuth_deg = 60;  ///< camera position around the vertical: 0 looks downstream (+x), 90 shows +x to the right
  double elevation_deg = 20;  ///< height of the camera above the horizon as seen from the scene
};

/// A camera at the distance where `box` just fills a picture of the given aspect (width over height), with gravity
/// pointing down. Without gravity, up is +z.
[[nodiscard]] Camera fitted_camera(const ViewBox& box, const Vec3& gravity, const ViewDirection& from, double aspect);

/// Turns pixels into rays and points into pixels.
class Projection {
 public:
  /// Throws std::logic_error if eye and target coincide or `up` lies along the view.
  Projection(const Camera& camera, int width, int height);
  /// The ray through a place of the picture (pixels).
  [[nodiscard]] Ray ray(const Point& pixel) const;
  /// Where a point in front of the camera appears (pixels).
  [[nodiscard]] Point pixel(const Vec3& position) const;
  /// Angle between neighbouring pixels in the middle of the picture, rad.
  [[nodiscard]] float pixel_angle() const { return scale_; }
  [[nodiscard]] const Vec3f& right() const { return right_; }
  [[nodiscard]] const Vec3f& up() const { return up_; }
  [[nodiscard]] const Vec3f& forward() const { return forward_; }

 private:
  Vec3f eye_, right_, up_, forward_;
  Point middle_;
  float scale_;
};

}  // namespace lahar::cases
