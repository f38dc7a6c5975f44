#include "cases/assembly/rigid_barrier.h"

#include <gtest/gtest.h>

#include "cases/assembly/geometry.h"
#include "cases/scene/writer.h"
#include "tests/cases/assembly/rejections.h"

namespace lahar::scene {
namespace {

const std::vector<std::string> kSlits{"rigid_barrier.enabled=true",     "rigid_barrier.origin_m=[0.2, 0, 0]",
                                      "rigid_barrier.width_m=0.38",     "rigid_barrier.height_m=0.1",
                                      "rigid_barrier.thickness_m=0.02", "rigid_barrier.material=steel",
                                      "rigid_barrier.slits=3",          "rigid_barrier.slit_width_m=0.02"};

std::vector<std::string> with(std::vector<std::string> set, const std::string& more) {
  set.push_back(more);
  return set;
}

TEST(RigidBarrier, BecomesPiersWithSlitsBetween) {
  const Scene scene = load(case_file("hanging_net/scene.toml"), kSlits);
  ASSERT_EQ(scene.walls.size(), 4u);
  EXPECT_EQ(scene.walls[3].name, "rigid_barrier_3");
  const Walls walls = make_walls(scene);
  const double pier = (0.38 - 3 * 0.02) / 4;
  for (int k = 0; k < 3; ++k) {
    const double slit = (k + 1) * pier + (k + 0.5) * 0.02;
    EXPECT_NEAR(walls.nearest(Vec3(0.21, slit, 0.05)).distance, 0.01, 1e-12) << k;
    EXPECT_LT(walls.nearest(Vec3(0.21, slit + 0.011, 0.05)).distance, 0) << k;
  }
  EXPECT_NEAR(scene.walls[3].upper.y(), 0.38, 1e-12);
}

TEST(RigidBarrier, PiersHaveItsMaterialAndSlip) {
  const Scene scene = load(case_file("hanging_net/scene.toml"), with(kSlits, "rigid_barrier.slip=free_slip"));
  ASSERT_EQ(scene.walls.size(), 4u);
  for (const WallSettings& pier : scene.walls) {
    EXPECT_EQ(pier.material, "steel");
    EXPECT_EQ(pier.slip, WallSlip::free_slip);
  }
}

TEST(RigidBarrier, TheResolvedSceneHasItsWallsOnce) {
  const Scene scene = load(case_file("hanging_net/scene.toml"), kSlits);
  const ScratchFolder folder;
  const auto file = folder.write("again.toml", to_toml(scene));
  EXPECT_EQ(load(file, {}), scene);
}

/// As of a net, with a fluid and where the scene names no section.
TEST(RigidBarrier, ItsUpstreamFaceIsTheMeasuredSection) {
  const auto dam = case_file("dam_break/scene.toml");
  const std::vector<std::string> in_dam{"rigid_barrier.enabled=true", "rigid_barrier.origin_m=[0.8, 0, 0]",
                                        "rigid_barrier.width_m=0.3", "rigid_barrier.height_m=0.1",
                                        "rigid_barrier.thickness_m=0.1"};
  EXPECT_FALSE(load(dam).measure.section_x.has_value());
  const Scene scene = load(dam, in_dam);
  EXPECT_EQ(scene.measure.section_x, 0.8);
  EXPECT_EQ(load(dam, with(in_dam, "measure.section_x_m=0.7")).measure.section_x, 0.7);
  EXPECT_FALSE(load(case_file("hanging_net/scene.toml"), kSlits).measure.section_x.has_value()) << "no fluid";
  const ScratchFolder folder;
  EXPECT_EQ(load(folder.write("again.toml", to_toml(scene)), {}), scene);
  expect_rejection(
      dam, {with(in_dam, "rigid_barrier.origin_m=[1.4, 0, 0]"), "measure.outflow_distance_m", "leads to x = 1.725"});
}

/// A net beside it keeps the section.
TEST(RigidBarrier, ANetIsMeasuredRatherThanAWall) {
  EXPECT_EQ(load(case_file("debris_flow/scene.toml"),
                 {"barrier.net.width_m=0.38", "barrier.net.height_m=0.26", "rigid_barrier.enabled=true",
                  "rigid_barrier.origin_m=[4.6, 0, 0]", "rigid_barrier.width_m=1.8", "rigid_barrier.height_m=0.1",
                  "rigid_barrier.thickness_m=0.1", "rigid_barrier.material=steel"})
                .measure.section_x,
            4.1);
}

TEST(RigidBarrier, RefusesSlitsThatLeaveNothing) {
  const auto file = case_file("hanging_net/scene.toml");
  expect_rejection(file, {with(kSlits, "rigid_barrier.slit_width_m=0.2"), "rigid_barrier.slits", "leave nothing"});
  expect_rejection(file, {with(kSlits, "rigid_barrier.slit_width_m=0"), "rigid_barrier.slit_width_m", "is 0"});
  expect_rejection(file, {with(kSlits, "rigid_barrier.slits=0"), "rigid_barrier.slit_width_m", "without slits"});
  expect_rejection(file, {with(kSlits, "rigid_barrier.height_m=0"), "rigid_barrier.height_m", "above 0"});
  for (const char* material : {"", "stel"})
    expect_rejection(file, {with(kSlits, std::string("rigid_barrier.material=") + (*material ? material : "''")),
                            "rigid_barrier.material", "expected the name of a table [materials.NAME]"});
  expect_rejection(
      file, {with(kSlits, "rigid_barrier.material=\"a\\nb\""), "rigid_barrier.material", "is \"a\\u000Ab\", expected"});
}

}  // namespace
}  // namespace lahar::scene
