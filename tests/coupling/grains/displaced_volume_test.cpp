#include "coupling/grains/displaced_volume.h"

#include <gtest/gtest.h>

#include <numbers>

#include "coupling/grains/sphere_fraction.h"
#include "coupling/solid_fields.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

/// A tank half full of water, cells of 2 cm, and one grain; no step is made.
class DisplacedVolumeTest : public testing::Test {
 protected:
  explicit DisplacedVolumeTest(const Vec3& velocity = Vec3::Zero()) : fluid_(tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4)) {
    lbm::LiquidRegion water{Vec3::Zero(), Vec3(0.32, 0.32, 0.165)};
    water.velocity = velocity;
    fluid_.fill({water});
    particles_.add(grain(Vec3(0.15, 0.16, 0.25), kRadius, 2500));
  }
  void map() {
    displaced_.measure_former(fluid_, map_);
    map_.update(fluid_, particles_, [](double, GridSphere<double>& s) { s.surface = -2, s.reach = covered_reach(s); });
    for (const GrainInBlock& pair : map_.pairs()) fluid_.grid().require_body(pair.block);
    displaced_.begin(map_);
    map_.by_block().for_each_block([&](std::size_t b) { displaced_.measure_block(fluid_, map_, b); });
    displaced_.book(fluid_, map_);
  }
  /// Of all interface cells, in cells.
  [[nodiscard]] double surface_mass() {
    double sum = 0;
    for (const lbm::BlockIndex b : fluid_.grid().owned())
      if (const auto* surface = fluid_.grid().block(b).surface)
        for (int k = 0; k < surface->count; ++k) sum += surface->mass[surface->cells[static_cast<std::size_t>(k)]];
    return sum;
  }

  /// Of the one grain, cells.
  [[nodiscard]] double wet_volume() const { return displaced_.wet_volume_of(map_.grains()[0]); }

  static constexpr double kRadius = 0.05, kCells = 4.0 / 3.0 * std::numbers::pi * 2.5 * 2.5 * 2.5;
  lbm::Fluid<double> fluid_;
  dem::Particles particles_;
  GrainMap<double> map_;
  DisplacedVolume<double> displaced_;
};

TEST_F(DisplacedVolumeTest, GoesToTheInterfaceCellsThoseNearByOrThePool) {
  map();
  EXPECT_EQ(wet_volume(), 0);
  const double before = surface_mass() + fluid_.account().pool;
  const double surface = surface_mass();
  double z = 0.22;
  for (; z > 0.15; z -= 2e-4) {
    particles_.position.set(0, Vec3(0.15, 0.16, z));
    map();
    ASSERT_NEAR(surface_mass() + fluid_.account().pool - before, wet_volume(), 1e-9) << z;
  }
  EXPECT_GT(surface_mass(), surface + 0.4 * kCells);  // at the waterline they take it
  const double nearby = fluid_.account().paid_nearby, pooled = fluid_.account().pooled_total;
  particles_.position.set(0, Vec3(0.15, 0.16, 0.08));
  map();
  EXPECT_NEAR(wet_volume(), kCells, 1e-9);
  // Deep under water there is no interface cell of its own to give it to, and not enough room in those near by.
  EXPECT_NEAR(surface_mass() + fluid_.account().pool - before, kCells, 1e-9);
  EXPECT_GT(fluid_.account().paid_nearby, nearby + 2);
  EXPECT_GT(fluid_.account().pool, 1);
  EXPECT_NEAR(fluid_.account().pooled_total, pooled + fluid_.account().pool, 1e-9);
}

/// Grains that fill with the level end where the water ends: half of one whose centre lies there is wet.
TEST_F(DisplacedVolumeTest, EndsAtTheSurfaceWhereGrainsFillWithTheLevel) {
  displaced_ = DisplacedVolume<double>(true);
  double wet = 0;
  int places = 0;
  for (double x = 0.14; x < 0.16; x += 0.003, ++places) {
    particles_.position.set(0, Vec3(x, 0.16, 0.165));
    map();
    wet += wet_volume() / kCells;
    ASSERT_NEAR(surface_mass() + fluid_.account().pool - wet_volume(), 16 * 16 * 0.25, 1e-9);
  }
  EXPECT_NEAR(wet / places, 0.5, 0.01);
}

class DisplacedVolumeInAStream : public DisplacedVolumeTest {
 protected:
  DisplacedVolumeInAStream() : DisplacedVolumeTest(Vec3(0.3, -0.2, 0)) {}
};

/// A grain comes into the water and starts to leave it again.
TEST_F(DisplacedVolumeInAStream, WhatIsHandedOutHasTheVelocityOfItsCells) {
  const Vec3 u = Vec3(0.3, -0.2, 0) * fluid_.units().velocity_to_lu(1.0);
  displaced_ = DisplacedVolume<double>(true);
  double wet = 0;
  for (const double z : {0.22, 0.2, 0.19, 0.191}) {
    particles_.position.set(0, Vec3(0.15, 0.16, z));
    map();
    const auto handed = displaced_.handed_by(map_.grains()[0]);
    EXPECT_NEAR(handed.mass, wet_volume() - wet, 1e-9) << z;
    for (const int a : {0, 1}) EXPECT_NEAR(handed.momentum[a], handed.mass * u[a], 1e-9) << z;
    wet = wet_volume();
  }
  EXPECT_GT(wet, 0);
}

TEST_F(DisplacedVolumeTest, ARemovedGrainLeavesAVoid) {
  particles_.position.set(0, Vec3(0.15, 0.16, 0.08));
  map();
  const double before = surface_mass(), pool = fluid_.account().pool;
  particles_.remove(0);
  map();
  EXPECT_NEAR(surface_mass() + fluid_.account().pool, before + pool - kCells, 1e-9);
  EXPECT_LT(surface_mass(), before - 2);  // those near by pay what they may
  EXPECT_TRUE(map_.grains().empty());
}

/// What a grain displaced is not lost where it is out of reach of all blocks at once.
TEST_F(DisplacedVolumeTest, AGrainThatFliesOutOfAllBlocksLeavesAVoid) {
  particles_.position.set(0, Vec3(0.15, 0.16, 0.08));
  map();
  const double before = surface_mass() + fluid_.account().pool;
  particles_.position.set(0, Vec3(0.15, 0.16, 10));
  map();
  EXPECT_EQ(wet_volume(), 0);
  EXPECT_NEAR(surface_mass() + fluid_.account().pool, before - kCells, 1e-9);
}

/// Interface cells that are covered hold no liquid: they are set full, and what they lacked is taken from the others.
TEST_F(DisplacedVolumeTest, CoveredCellsAreSetFull) {
  particles_.position.set(0, Vec3(0.15, 0.16, 0.165));
  map();
  auto& grid = fluid_.grid();
  int covered = 0;
  for (const GrainInBlock& pair : map_.pairs()) {
    lbm::Block<double>& block = grid.block(pair.block);
    if (!block.surface) continue;
    for (int k = 0; k < block.surface->count; ++k) {
      const int n = block.surface->cells[static_cast<std::size_t>(k)];
      if ((grid.centre(pair.block, n) - Vec3(0.15, 0.16, 0.165)).norm() > 0.03) continue;
      block.body->covered[static_cast<std::size_t>(n / 8)] |= static_cast<std::uint8_t>(1 << n % 8);
      block.surface->mass[n] -= 0.2, ++covered;
    }
  }
  ASSERT_GT(covered, 4);
  const double before = surface_mass() + fluid_.account().pool;
  map();
  EXPECT_NEAR(surface_mass() + fluid_.account().pool, before, 1e-10);
  for (const GrainInBlock& pair : map_.pairs()) {
    const lbm::Block<double>& block = grid.block(pair.block);
    for (int k = 0; block.surface && k < block.surface->count; ++k) {
      const int n = block.surface->cells[static_cast<std::size_t>(k)];
      if (block.body->covered[static_cast<std::size_t>(n / 8)] >> n % 8 & 1) {
        EXPECT_EQ(block.surface->mass[n], 1 + block.surface->density[n]);
      }
    }
  }
}

}  // namespace
}  // namespace lahar::coupling
