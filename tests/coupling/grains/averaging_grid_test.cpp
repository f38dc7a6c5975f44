#include "coupling/grains/averaging_grid.h"

#include <gtest/gtest.h>

#include <map>

namespace lahar::coupling {
namespace {

lbm::Domain box(lbm::FaceKind along_y) {
  lbm::DomainSpec spec;
  spec.upper = Vec3(1.0, 0.8, 0.35);
  spec.cell_size = 0.05;
  spec.faces[2] = spec.faces[3] = along_y;
  return lbm::Domain(spec);
}

/// Nodes are never nearer than the averaging length, and stand in the middles of equal lengths.
TEST(AveragingGrid, DividesTheDomain) {
  const AveragingGrid grid(box(lbm::FaceKind::periodic), 0.15);
  EXPECT_EQ(grid.size(), 6U * 5U * 2U);
  EXPECT_NEAR(grid.spacing().x(), 20 / 6.0, 1e-12);
  EXPECT_NEAR(grid.spacing().y(), 16 / 5.0, 1e-12);
  EXPECT_NEAR(grid.spacing().z(), 7 / 2.0, 1e-12);
  EXPECT_EQ(AveragingGrid::divisions(0.29, 0.15), 1);
  EXPECT_EQ(AveragingGrid::divisions(0.1, 0.15), 1);
  EXPECT_EQ(AveragingGrid::divisions(3 * 0.15, 0.15), 3);
  const Vec3i first = box(lbm::FaceKind::periodic).first();
  const auto at_node = grid.between(0, first.x() + 1.5 * 20 / 6.0);
  EXPECT_NEAR(at_node.below + at_node.above_weight, 1, 1e-12);
}

/// Weights sum to 1 everywhere, and give back what is linear between the outer nodes.
TEST(AveragingGrid, SharesAPoint) {
  const lbm::Domain domain = box(lbm::FaceKind::closed);
  const AveragingGrid grid(domain, 0.15);
  std::map<std::size_t, Vec3> place;
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 2; ++z)
        place[grid.index({x, y, z})] =
            domain.first().cast<double>() + Vec3(x + 0.5, y + 0.5, z + 0.5).cwiseProduct(grid.spacing());
  EXPECT_EQ(place.size(), grid.size());
  for (const Vec3& p : {Vec3(5.1, 6.2, 4.0), Vec3(9.9, 3.3, 5.5), Vec3(17, 12, 3)}) {
    double sum = 0;
    Vec3 mean = Vec3::Zero();
    grid.around(p, [&](std::size_t node, double weight) { sum += weight, mean += weight * place[node]; });
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR((mean - p).norm(), 0, 1e-9);
  }
  double outside = 0;
  grid.around(Vec3(0.2, 0.2, 0.2), [&](std::size_t node, double weight) {
    outside += weight;
    EXPECT_TRUE(node == grid.index({0, 0, 0}) || weight == 0);
  });
  EXPECT_NEAR(outside, 1, 1e-12);
}

/// All nodes that places in a box around a point ask for, each once.
TEST(AveragingGrid, NodesWithinReach) {
  const AveragingGrid grid(box(lbm::FaceKind::closed), 0.15);
  const double half = 0.5 * grid.spacing().minCoeff();
  for (const Vec3& p : {Vec3(5.1, 6.2, 4.0), Vec3(9.9, 3.3, 5.5)}) {
    std::map<std::size_t, int> visits;
    grid.within(p, half, [&](std::size_t node) { ++visits[node]; });
    EXPECT_LE(visits.size(), 27U);
    for (int n = 0; n < 125; ++n) {
      const Vec3 aside = half * (Vec3(n % 5, n / 5 % 5, n / 25) / 2 - Vec3::Ones());
      grid.around(p + aside,
                  [&](std::size_t node, double weight) { EXPECT_TRUE(weight == 0 || visits.contains(node)); });
    }
  }
}

TEST(AveragingGrid, APeriodicAxisGoesRound) {
  const AveragingGrid grid(box(lbm::FaceKind::periodic), 0.15);
  EXPECT_EQ(grid.index({2, 5, 1}), grid.index({2, 0, 1}));
  EXPECT_EQ(grid.index({2, -1, 1}), grid.index({2, 4, 1}));
  EXPECT_EQ(grid.index({-1, 0, 1}), grid.index({0, 0, 1}));
}

}  // namespace
}  // namespace lahar::coupling
