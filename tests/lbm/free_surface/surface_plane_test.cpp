#include "lbm/free_surface/surface_plane.h"

#include <gtest/gtest.h>

#include <random>

namespace lahar::lbm {
namespace {

/// Share of the unit cell's points p (from its centre) with a . p + depth > 0.
double share_below(const double (&a)[3], double depth) {
  constexpr int kPoints = 60;
  int inside = 0;
  const auto place = [](int i) { return (i + 0.5) / kPoints - 0.5; };
  for (int x = 0; x < kPoints; ++x)
    for (int y = 0; y < kPoints; ++y)
      for (int z = 0; z < kPoints; ++z) inside += a[0] * place(x) + a[1] * place(y) + a[2] * place(z) + depth > 0;
  return static_cast<double>(inside) / (kPoints * kPoints * kPoints);
}

/// The plane cuts off the fill level, whatever its direction: along an axis, in a coordinate plane, nearly so, oblique.
TEST(SurfacePlane, CutsOffTheFillLevel) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 60; ++n) {
    double a[3] = {any(random), any(random), any(random)};
    if (n % 3 == 1)
      a[n % 2] = 0;
    else if (n % 5 == 0)
      a[0] = a[2] = 0;
    else if (n % 7 == 0)
      a[1] *= 1e-4;
    const double fill = 0.5 + 0.5 * any(random);
    // One layer of points of the 60 is 1.7 %.
    EXPECT_NEAR(share_below(a, depth_of_centre(a, fill)), fill, 0.012) << a[0] << " " << a[1] << " " << a[2];
  }
}

TEST(SurfacePlane, ScalesWithTheVectorAndNeedsNone) {
  const double a[3] = {0.1, -0.2, 0.5}, b[3] = {0.01, -0.02, 0.05}, none[3] = {0, 0, 0};
  EXPECT_NEAR(depth_of_centre(a, 0.3), 10 * depth_of_centre(b, 0.3), 1e-12);
  EXPECT_EQ(depth_of_centre(none, 0.3), 0);
  const double up[3] = {0, 0, -2};
  EXPECT_NEAR(depth_of_centre(up, 0.8), 0.6, 1e-12);
}

/// Eight cells at once, in every range of volumes, as one by one; none in cells that are not asked for.
TEST(SurfacePlane, ManyCellsAsOneByOne) {
  using V = Row<double>;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 400; ++n) {
    V a[3], fill;
    auto wanted = V::mask_type::all(true);
    wanted.set(static_cast<std::size_t>(n % 8), false);
    for (std::size_t k = 0; k < V::size(); ++k) {
      for (V& component : a) component.set(k, n % 4 == 0 && any(random) < 0 ? 0 : any(random));
      fill.set(k, n % 5 == 0 ? 0.01 * std::abs(any(random)) : 0.5 + 0.5 * any(random));
    }
    const V depths = depths_of_centres(a, fill, wanted);
    for (std::size_t k = 0; k < V::size(); ++k) {
      const double one[3] = {a[0][k], a[1][k], a[2][k]};
      EXPECT_NEAR(depths[k], wanted[k] ? depth_of_centre(one, fill[k]) : 0.0, 1e-14) << n << " " << k;
    }
  }
}

}  // namespace
}  // namespace lahar::lbm
