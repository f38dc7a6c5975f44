// Grains on a floor with an open end: how many are there, gone, and behind the floor.
#include "cases/observers/grain_count.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cases/observers/sampled.h"
#include "tests/cases/observers/two_balls.h"

namespace lahar::cases {
namespace {

const std::string kOnFloor = two_balls + R"([[wall]]
name = "floor"
shape = "box"
lower_m = [0, 0, 0]
upper_m = [0.7, 1, 0.1]
material = "rock"
)";

bool passes(const Sampled& run) {
  const std::vector<ResultCheck> checks = run.observers.checks();
  const auto found =
      std::find_if(checks.begin(), checks.end(), [](const auto& c) { return c.name == "grains_behind_walls"; });
  return found != checks.end() && found->pass;
}

void expect(const Sampled& run, double gone, double behind) {
  const Metrics metrics = run.metrics();
  EXPECT_EQ(metrics.at("grains_at_start"), 2);
  EXPECT_EQ(metrics.at("grains_gone"), gone);
  EXPECT_EQ(metrics.at("grains_behind_walls"), behind);
  EXPECT_EQ(passes(run), behind == 0);
}

TEST(GrainCount, GrainsLeaveBeyondTheFloor) {
  Sampled run(scene::load_text(kOnFloor));
  run.take_row();
  expect(run, 0, 0);
  run.solids().particles().position.set(0, Vec3(1.06, 0.5, 0.05));
  run.observers.after_step();
  run.solids().remove(0);
  run.take_row();
  expect(run, 1, 0);
  run.solids().particles().position.set(1, Vec3(0.8, 0.5, -0.04));  // falls off the end of the floor
  run.take_row();
  expect(run, 2, 0);
}

/// A centre in the floor, however little; and it stays counted, once.
TEST(GrainCount, OneBehindTheFloorIsSeenAtARow) {
  Sampled run(scene::load_text(kOnFloor));
  run.take_row();
  dem::Particles& p = run.solids().particles();
  p.position.set(0, Vec3(0.3, 0.5, 0.1001));
  run.take_row();
  expect(run, 0, 0);
  p.position.set(0, Vec3(0.3, 0.5, 0.0999));
  run.take_row();
  expect(run, 0, 1);
  p.position.set(0, Vec3(0.3, 0.5, 0.5));
  run.take_row();
  run.take_row();
  expect(run, 0, 1);
}

/// Between two rows, through a floor that goes on for ever.
TEST(GrainCount, OneThatLeavesThroughTheFloorIsSeen) {
  Sampled run(scene::load_text(two_balls + R"([[wall]]
name = "floor"
shape = "plane"
point_m = [0, 0, 0.1]
normal = [0, 0, 1]
material = "rock"
)"));
  run.take_row();
  run.solids().particles().position.set(0, Vec3(0.3, 0.5, -0.06));
  run.observers.after_step();
  run.solids().remove(0);
  run.take_row();
  expect(run, 1, 1);
}

TEST(GrainCount, AGateThatHasOpenedIsNoWall) {
  Sampled run(scene::load_text(kOnFloor, {"wall[0].opens_at_s=1e-9"}));
  run.take_row();
  run.solids().particles().position.set(0, Vec3(0.3, 0.5, 0.05));
  run.step();
  run.take_row();
  expect(run, 0, 0);
}

TEST(GrainCount, NoWallIsNoCheck) {
  Sampled run(scene::load_text(two_balls));
  run.take_row();
  EXPECT_EQ(run.metrics().at("grains_at_start"), 2);
  EXPECT_FALSE(run.metrics().contains("grains_behind_walls"));
  EXPECT_FALSE(passes(run));
}

TEST(GrainCount, FixedOnesAreObstacles) {
  Sampled run(
      scene::load_text(kOnFloor, {"grains.sphere[1].fixed=true", "grains.sphere[1].position_m=[0.3,0.5,0.05]"}));
  run.take_row();
  EXPECT_EQ(run.metrics().at("grains_at_start"), 1);
  EXPECT_EQ(run.metrics().at("grains_behind_walls"), 0);
  EXPECT_TRUE(passes(run));
}

}  // namespace
}  // namespace lahar::cases
