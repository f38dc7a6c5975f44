#include "barrier/ring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "barrier/dissipator.h"
#include "core/check.h"

namespace lahar::barrier {
namespace {

TEST(Ring, FlatRingIsTheRegularPolygon) {
  const RingShape shape{0.3, 60};
  EXPECT_NEAR(bead_spacing(shape), 0.3 * std::sin(std::numbers::pi / 60), 1e-15);
  for (const Vec3& p : ring_line(shape).points) {
    EXPECT_NEAR(p.head<2>().norm(), 0.15, 1e-9);
    EXPECT_EQ(p.z(), 0);
  }
}

TEST(Ring, WaveKeepsTheWireLengthAndTheSpacing) {
  const RingShape shape{0.07, 36, 0.004, 0.5};
  const Polyline line = ring_line(shape);
  double highest = 0, widest = 0;
  for (std::size_t s = 0; s < line.segments(); ++s) {
    EXPECT_NEAR((line.end(s) - line.start(s)).norm() / bead_spacing(shape), 1, 1e-6);
    highest = std::max(highest, line.start(s).z());
    widest = std::max(widest, line.start(s).head<2>().norm());
  }
  EXPECT_NEAR(highest, 0.004, 2e-4);
  // Length of the wave to second order in its slope 4 A / r: 2 pi r (1 + (4 A / r)^2 / 4).
  EXPECT_NEAR(widest * (1 + 0.25 * std::pow(4 * 0.004 / widest, 2)), 0.035, 0.001);
  EXPECT_LT(widest, 0.0345);
}

TEST(Ring, RefusesAWaveThatNeedsMoreWireThanThereIs) {
  EXPECT_THROW((void)ring_line({0.07, 36, 0.05, 0}), InputError);
  EXPECT_THROW((void)ring_line({0.07, 4, 0, 0}), InputError);
}

TEST(Ring, IsAddedInAnyPoseAsAClosedChainAtRest) {
  dem::Particles particles;
  dem::Bonds bonds;
  const int sort = bonds.add_sort(wire_bond(1e9, 0.003));
  const RingPose pose{{1, 2, 3}, Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  const Wire ring = add_ring({0.07, 36, 0.004, 0}, pose, {0.0061, 7800, 2}, sort, 5, particles, bonds);
  ASSERT_EQ(particles.size(), 36u);
  ASSERT_EQ(bonds.size(), 36u);
  EXPECT_EQ(bonds.i[35], 35u);
  EXPECT_EQ(bonds.j[35], 0u);
  Vec3 centre = Vec3::Zero();
  for (std::size_t k = 0; k < 36; ++k) {
    centre += particles.position[k] / 36;
    EXPECT_EQ(particles.body[k], 5);
    EXPECT_EQ(particles.material[k], 2);
    EXPECT_EQ(particles.kind[k], dem::ParticleKind::bead);
    EXPECT_LT(std::abs(particles.position[k].y() - 2), 0.00401);
    EXPECT_NEAR(bonds.rest_length[k], 0.07 * std::sin(std::numbers::pi / 36), 1e-8);
  }
  EXPECT_LT((centre - Vec3(1, 2, 3)).norm(), 1e-9);
  EXPECT_TRUE(is_whole(ring, bonds));
  bonds.intact[7] = 0;
  EXPECT_FALSE(is_whole(ring, bonds));
}

}  // namespace
}  // namespace lahar::barrier
