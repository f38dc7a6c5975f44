#include "cases/assembly/simulation.h"

#include <gtest/gtest.h>

#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

class BothPrecisions : public testing::TestWithParam<const char*> {
 protected:
  scene::Scene scene_ = scene::load(scene::source_folder() / "tests/integration/small_debris_flow.toml",
                                    {std::string("run.precision=") + GetParam()});
};

TEST_P(BothPrecisions, HasAllPartsAndAdvances) {
  const auto simulation = build_simulation(scene_);
  ASSERT_TRUE(simulation->fluid() && simulation->solids() && simulation->net());
  const double box = 1000 * 0.3 * 0.25976 * 0.2;  // kg; grains take a part of it
  EXPECT_GT(simulation->fluid()->liquid_mass(), 0.4 * box);
  EXPECT_LT(simulation->fluid()->liquid_mass(), box);
  simulation->advance();
  EXPECT_EQ(simulation->time(), simulation->time_step());
  EXPECT_EQ(simulation->fluid()->steps(), 1);
  EXPECT_GT(simulation->seconds().at("fluid"), 0);
  EXPECT_GT(simulation->seconds().at("solids.contact"), 0);
}

TEST_P(BothPrecisions, BeforeACheckpointItHoldsNoLiquid) {
  const auto simulation = build_simulation(scene_, Beginning::checkpoint);
  EXPECT_EQ(simulation->fluid()->wet_cells(), 0u);
  EXPECT_EQ(simulation->solids()->particles().size(), build_simulation(scene_)->solids()->particles().size());
}

INSTANTIATE_TEST_SUITE_P(Simulation, BothPrecisions, testing::Values("float", "double"));

TEST(Simulation, PartsThatTheSceneLacksAreNull) {
  const auto simulation = build_simulation(scene::load_text(scene::small_scene));
  EXPECT_EQ(simulation->fluid(), nullptr);
  EXPECT_EQ(simulation->net(), nullptr);
  EXPECT_NE(simulation->solids(), nullptr);
}

}  // namespace
}  // namespace lahar::cases
