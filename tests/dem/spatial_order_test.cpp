#include "dem/spatial_order.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

double mean_step(const Particles& p) {
  double sum = 0;
  for (std::size_t i = 1; i < p.size(); ++i) sum += (p.position[i] - p.position[i - 1]).norm();
  return sum / static_cast<double>(p.size() - 1);
}

TEST(SpatialOrder, BringsNeighboursTogether) {
  Particles p = testing::random_cloud(500, 0.02, 500, 0.01, {1, 1, 1}, 1, 3);
  const double before = mean_step(p);  // mean distance of random points in a cube: 0.66
  p.renumber(spatial_order(p));
  EXPECT_GT(before, 0.6);
  EXPECT_LT(mean_step(p), 0.15);  // ten particles a side: 0.1 m
}

TEST(SpatialOrder, FollowsTheMortonCurve) {
  Particles p;  // eight cells: the bits of the coordinates interleave, x lowest
  for (const int k : {5, 0, 7, 2, 1, 6, 3, 4}) {
    const Vec3 cell(k & 1, k >> 1 & 1, k >> 2 & 1);
    p.add(testing::sphere(2.0 * cell + 0.1 * Vec3::Ones(), 1, 1000));
  }
  p.renumber(spatial_order(p));
  for (int k = 0; k < 8; ++k)
    EXPECT_LT((p.position[static_cast<std::size_t>(k)] - 2.0 * Vec3(k & 1, k >> 1 & 1, k >> 2 & 1)).norm(), 0.2) << k;
}

TEST(SpatialOrder, KeepsBeadsAlongTheirChainsAndPutsRemovedOnesLast) {
  Particles p;
  for (int n = 0; n < 60; ++n) p.add(testing::sphere({0.1 * (n * 7 % 60), 0, 0}, 0.02, 1000));
  for (int body = 0; body < 2; ++body)
    for (int n = 0; n < 50; ++n) {
      ParticleSpec bead = testing::sphere({0.1 * n, 0.01 * body, 0}, 0.01, 1000);
      bead.kind = ParticleKind::bead, bead.body = body;
      p.add(bead);
    }
  p.remove(11);
  p.renumber(spatial_order(p));
  EXPECT_EQ(p.id(p.size() - 1), 11U);
  for (ParticleId first : {60U, 110U})
    for (ParticleId n = 1; n < 50; ++n) EXPECT_EQ(p.index(first + n), p.index(first) + n);
}

}  // namespace
}  // namespace lahar::dem
