#include "cases/pictures/backdrop.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lahar::cases {
namespace {

const ViewBox kBox{Vec3::Zero(), Vec3(4, 2, 1)};

TEST(Backdrop, FlatWallsEndAtTheBoxAndHideFromBehind) {
  Walls walls;
  walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  walls.add({"near side", HalfSpace{Vec3::Zero(), Vec3::UnitY()}});
  walls.add({"far side", HalfSpace{Vec3(0, 2, 0), -Vec3::UnitY()}});
  const Backdrop backdrop(walls, kBox, Vec3(2, -5, 3));
  const BackdropHit bed = backdrop.nearest({Vec3f(1, 1, 3), -Vec3f::UnitZ()}, kNoHit);
  EXPECT_EQ(bed.wall, 0);
  EXPECT_TRUE(bed.flat);
  EXPECT_NEAR(bed.distance, 3, 1e-5);
  EXPECT_EQ(backdrop.nearest({Vec3f(5, 1, 3), -Vec3f::UnitZ()}, kNoHit).wall, -1) << "outside the box";
  EXPECT_EQ(backdrop.nearest({Vec3f(1, 1, 3), -Vec3f::UnitZ()}, 2.5F).wall, -1) << "beyond the limit";
  const BackdropHit side = backdrop.nearest({Vec3f(2, -5, 0.5F), Vec3f::UnitY()}, kNoHit);
  EXPECT_EQ(side.wall, 2) << "the near wall is seen from behind and must be left out";
  EXPECT_NEAR(side.distance, 7, 1e-5);
}

TEST(Backdrop, SolidsAreHitWhereTheyAre) {
  Walls walls;
  walls.add({"block", SolidBox{Vec3(1, 0.5, 0), Vec3(1.5, 1.5, 0.5)}});
  walls.add({"post", SolidCylinder{Vec3(3, 1, 0), Vec3(3, 1, 0.9), 0.1}});
  walls.add({"stone", SolidSphere{Vec3(2, 1, 0.5), 0.25}});
  const Backdrop backdrop(walls, kBox, Vec3(-3, 1, 1));
  const float tolerance = 2e-3F;
  const BackdropHit block = backdrop.nearest({Vec3f(-1, 1, 0.25F), Vec3f::UnitX()}, kNoHit);
  EXPECT_EQ(block.wall, 0);
  EXPECT_NEAR(block.distance, 2, tolerance);
  EXPECT_TRUE(block.normal.isApprox(-Vec3f::UnitX(), 1e-3F));
  const BackdropHit stone = backdrop.nearest({Vec3f(2, 1, 2), -Vec3f::UnitZ()}, kNoHit);
  EXPECT_EQ(stone.wall, 2);
  EXPECT_NEAR(stone.distance, 1.25F, tolerance);
  const BackdropHit post = backdrop.nearest({Vec3f(3.06F, -1, 0.5F), Vec3f::UnitY()}, kNoHit);
  EXPECT_EQ(post.wall, 1);
  EXPECT_NEAR(post.distance, 2 - 0.08F, tolerance);
  EXPECT_TRUE(backdrop.blocked({Vec3f(0, 1, 0.25F), Vec3f::UnitX()}));
  EXPECT_FALSE(backdrop.blocked({Vec3f(0, 1.9F, 0.25F), Vec3f::UnitX()}));
}

/// Ground that goes on beyond the view is cut off there: the cut looks outwards, wherever the nearest surface is.
TEST(Backdrop, CutSolidsShowTheirCut) {
  Walls walls;
  walls.add({"ground", SolidBox{Vec3(-1, -1, -2), Vec3(5, 3, 0.5)}});
  const Backdrop backdrop(walls, kBox, Vec3(2, -5, 3));
  for (const float z : {0.1F, 0.4F}) {  // nearer to the top than to the sides
    const BackdropHit cut = backdrop.nearest({Vec3f(2, -5, z), Vec3f::UnitY()}, kNoHit);
    EXPECT_EQ(cut.wall, 0);
    EXPECT_NEAR(cut.distance, 5, 1e-3);
    EXPECT_TRUE(cut.normal.isApprox(-Vec3f::UnitY(), 1e-3F)) << cut.normal.transpose();
  }
  EXPECT_TRUE(backdrop.nearest({Vec3f(2, 1, 3), -Vec3f::UnitZ()}, kNoHit).normal.isApprox(Vec3f::UnitZ(), 1e-3F));
}

TEST(Backdrop, GridLinesCoverTheirShareOfTheWall) {
  for (const float footprint : {0.002F, 0.05F}) {  // pixels finer and coarser than the lines
    double sum = 0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i)
      sum += grid_line_share(Vec3f(static_cast<float>(i) / n, 0.5F, 0), Vec3f::UnitZ(), 1.0F, 0.02F, footprint);
    EXPECT_NEAR(sum / n, 0.02, 0.004) << footprint;
  }
}

TEST(Backdrop, SpacingsAreRound) {
  EXPECT_FLOAT_EQ(round_spacing(5, 8), 1.0F);
  EXPECT_FLOAT_EQ(round_spacing(1.2, 8), 0.2F);
  EXPECT_FLOAT_EQ(round_spacing(40, 8), 5.0F);
}

}  // namespace
}  // namespace lahar::cases
