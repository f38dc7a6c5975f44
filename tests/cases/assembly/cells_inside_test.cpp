#include "cases/assembly/cells_inside.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/geometry.h"

namespace lahar::scene {
namespace {

constexpr double kAll = std::numeric_limits<double>::infinity();

CellBox box(const Vec3i& first, const Vec3i& end) { return {first, end, Vec3(-0.3, 0.1, 0), 0.01}; }

template <class Solid>
double one_by_one(const CellBox& b, const Solid& solid) {
  double cells = 0;
  for (int x = b.first.x(); x < b.end.x(); ++x)
    for (int y = b.first.y(); y < b.end.y(); ++y)
      for (int z = b.first.z(); z < b.end.z(); ++z)
        cells += solid.distance(Vec3(b.origin + b.cell_size * (Vec3(x, y, z) + Vec3::Constant(0.5)))) < 0;
  return cells;
}

template <class Solid>
void expect_as_one_by_one(const CellBox& b, const Solid& solid) {
  EXPECT_EQ(cells_inside(b, kAll, [&](const Vec3& p) { return solid.distance(p); }), one_by_one(b, solid));
}

TEST(CellsInside, AreThoseOfALookAtEach) {
  const CellBox b = box({-3, 2, 0}, {50, 41, 37});
  expect_as_one_by_one(b, SolidSphere{Vec3(-0.1, 0.3, 0.2), 0.123});
  expect_as_one_by_one(b, SolidCylinder{Vec3(-0.3, 0.1, 0), Vec3(0.2, 0.5, 0.37), 0.004});
  expect_as_one_by_one(b, SolidBox{Vec3(-0.2, 0.1, 0), Vec3(-0.1, 0.15, 0.3)});
  expect_as_one_by_one(b, HalfSpace{Vec3(0, 0.3, 0.2), Vec3(1, 2, -1).normalized()});
  expect_as_one_by_one(b, SolidSphere{Vec3(-0.1, 0.3, 0.2), 5});
}

TEST(CellsInside, OfNoneThereAreNone) {
  EXPECT_EQ(cells_inside(box({0, 0, 0}, {5, 0, 5}), kAll, [](const Vec3&) { return -1.0; }), 0);
}

/// Eight million cells.
TEST(CellsInside, LooksAlongTheSurface) {
  const SolidSphere ball{Vec3(0.7, 1.1, 1), 0.5};
  const CellBox b = box({0, 0, 0}, {200, 200, 200});
  int looks = 0;
  const auto distance = [&](const Vec3& p) { return ++looks, ball.distance(p); };
  EXPECT_NEAR(cells_inside(b, kAll, distance) / (4.0 / 3 * 3.14159265 * 50 * 50 * 50), 1, 0.001);
  EXPECT_LT(looks, 800'000);
  looks = 0;
  EXPECT_GE(cells_inside(b, 1, distance), 1);
  EXPECT_LT(looks, 10'000);
}

}  // namespace
}  // namespace lahar::scene
