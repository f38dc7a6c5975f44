// Boxes of liquid that end at walls between the faces of cells.
#include <gtest/gtest.h>

#include "cases/assembly/build.h"
#include "cases/assembly/simulation.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

/// A tank of 6.44 x 6.4 x 6.72 cells.
const std::string tank = R"([scene]
name = "tank"
[run]
duration_s = 1.0
[domain]
lower_m = [0, 0, 0]
upper_m = [0.161, 0.16, 0.168]
[fluid]
enabled = true
cell_size_m = 0.025
max_speed_m_s = 1.0
)";

struct Filled {
  std::size_t full = 0, part = 0;
};

Filled count(const std::string& text) {
  const auto simulation = build_simulation(scene::load_text(text));
  Filled cells;
  simulation->fluid()->for_each_wet_cell([&](const lbm::WetCell& c) {
    EXPECT_TRUE(c.fill_level == 1 || c.fill_level < 0.999);
    ++(c.fill_level == 1 ? cells.full : cells.part);
  });
  return cells;
}

TEST(LiquidRegions, ThatFillsTheDomainLeavesNoGas) {
  const Filled cells = count(tank + "[[fluid.region]]\nlower_m = [0, 0, 0]\nupper_m = [0.161, 0.16, 0.168]\n");
  EXPECT_EQ(cells.full, 6u * 6u * 7u);
  EXPECT_EQ(cells.part, 0u);
}

TEST(LiquidRegions, AFreeSurfaceStaysWhereItIs) {
  const Filled cells = count(tank + "[[fluid.region]]\nlower_m = [0, 0, 0]\nupper_m = [0.161, 0.16, 0.11]\n");
  EXPECT_EQ(cells.full, 6u * 6u * 4u);
  EXPECT_EQ(cells.part, 6u * 6u);
}

TEST(LiquidRegions, CellsThatAWallInTheTankCutsAreFilled) {
  const std::string wall =
      "[[wall]]\nname = \"weir\"\nshape = \"box\"\nlower_m = [0.09, 0, 0]\nupper_m = [0.16, 0.16, 0.168]\n";
  const Filled cells = count(tank + "[[fluid.region]]\nlower_m = [0, 0, 0]\nupper_m = [0.09, 0.16, 0.168]\n" + wall);
  EXPECT_EQ(cells.full, 4u * 6u * 7u);  // 3.6 cells, the fourth centre is free
  EXPECT_EQ(cells.part, 0u);
  // A wall that leaves a gap does not end the box.
  const Filled over =
      count(tank + "[[fluid.region]]\nlower_m = [0, 0, 0]\nupper_m = [0.09, 0.16, 0.168]\n" +
            "[[wall]]\nname = \"weir\"\nshape = \"box\"\nlower_m = [0.09, 0, 0]\nupper_m = [0.16, 0.16, 0.1]\n");
  EXPECT_EQ(over.part, 6u * 7u);
}

}  // namespace
}  // namespace lahar::cases
