#include "cases/pictures/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lahar::cases {
namespace {

TEST(Camera, PixelAndRayAreInverse) {
  const Projection projection({Vec3(1, -4, 2), Vec3(0.5, 1, 0), Vec3::UnitZ(), 40}, 640, 360);
  for (const Point& p : {Point(320, 180), Point(0, 0), Point(600, 300)}) {
    const Vec3f q = projection.ray(p).at(3.5F);
    EXPECT_LT((projection.pixel(q.cast<double>()) - p).norm(), 0.01F);
  }
}

TEST(Camera, FieldOfViewSpansTheHeight) {
  const Projection projection({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ(), 60}, 800, 600);
  const Vec3f top = projection.ray(Point(400, 0)).direction;
  EXPECT_NEAR(std::atan2(top.z(), top.x()), std::numbers::pi / 6, 1e-5);
  EXPECT_GT(projection.ray(Point(800, 300)).direction.dot(-Vec3f::UnitY()), 0) << "right of +x under +z is -y";
}

TEST(Camera, FittedCameraShowsTheBoxAndFillsThePicture) {
  const ViewBox box{Vec3(-1, 0, 0), Vec3(5, 1.5, 1.2)};
  const double slope = 25 * std::numbers::pi / 180;
  const Vec3 gravity(9.81 * std::sin(slope), 0, -9.81 * std::cos(slope));
  for (const double azimuth : {0.0, 30.0, 90.0, 200.0}) {
    const Camera camera = fitted_camera(box, gravity, {azimuth, 15}, 16.0 / 9);
    const Projection projection(camera, 1600, 900);
    Point lower(1e9F, 1e9F), upper = -lower;
    for (int n = 0; n < 8; ++n) {
      const Vec3 corner((n & 1) ? 5 : -1, (n & 2) ? 1.5 : 0, (n & 4) ? 1.2 : 0);
      lower = lower.cwiseMin(projection.pixel(corner)), upper = upper.cwiseMax(projection.pixel(corner));
    }
    EXPECT_GE(lower.minCoeff(), 0) << azimuth;
    EXPECT_LE(upper.x(), 1600) << azimuth;
    EXPECT_LE(upper.y(), 900) << azimuth;
    EXPECT_GT(std::max((upper.x() - lower.x()) / 1600, (upper.y() - lower.y()) / 900), 0.85F) << azimuth;
    // Gravity points straight down in the picture.
    const Point below = projection.pixel(camera.target + 0.2 * gravity.normalized()) - projection.pixel(camera.target);
    EXPECT_NEAR(below.x(), 0, 0.05);
    EXPECT_GT(below.y(), 0);
  }
}

/// Whatever the size of the box, it fills the same part of the picture; a box of no size has a camera too.
TEST(Camera, SmallBoxesAreFittedToo) {
  const auto width_of = [](double size) {
    const ViewBox box{Vec3::Zero(), Vec3::Constant(size)};
    const Projection projection(fitted_camera(box, Vec3(0, 0, -9.81), {115, 28}, 1), 900, 900);
    return projection.pixel(Vec3(size, 0, 0)).x() - projection.pixel(Vec3::Zero()).x();
  };
  for (const double size : {1e-3, 1e-4, 1e-5}) EXPECT_NEAR(width_of(size), width_of(1), 1) << size;
  const Camera camera = fitted_camera(ViewBox{}, Vec3(0, 0, -9.81), {115, 28}, 1);
  EXPECT_GT((camera.target - camera.eye).norm(), 0);
}

TEST(Camera, AzimuthTurnsFromDownstreamToTheSide) {
  const ViewBox box{Vec3::Zero(), Vec3::Ones()};
  const Vec3 gravity(0, 0, -9.81);
  const Camera along = fitted_camera(box, gravity, {0, 10}, 1), side = fitted_camera(box, gravity, {90, 10}, 1);
  EXPECT_GT((along.target - along.eye).normalized().x(), 0.95);
  EXPECT_GT(Projection(side, 100, 100).right().x(), 0.999);
}

TEST(Camera, RefusesDegenerateViews) {
  EXPECT_THROW(Projection({Vec3::Zero(), Vec3::Zero(), Vec3::UnitZ(), 30}, 10, 10), std::logic_error);
  EXPECT_THROW(Projection({Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitZ(), 30}, 10, 10), std::logic_error);
}

}  // namespace
}  // namespace lahar::cases
