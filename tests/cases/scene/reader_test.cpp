#include "cases/scene/reader.h"

#include <gtest/gtest.h>

#include "cases/scene/writer.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {
namespace {

/// A number with a point is shown as one.
TEST(Reader, ANumberThatIsNotWholeLooksLikeOne) {
  EXPECT_EQ(mistakes_in(case_file("bouncing_sphere/scene.toml"), {"run.seed=1.0"}),
            std::vector<std::string>{"--set run.seed=1.0:1:1: run.seed is 1.0, expected a whole number at least 0"});
}

TEST(Reader, ReportsEveryMistakeAtItsPlace) {
  const auto all = mistakes_in_text(R"([scene]
name = "x"
[run]
duration_s = -1.0
series_interval = 0.1
seed = 1.5
[domain]
lower_m = [0, 0, 0]
upper_m = [1, 1]
[fluid]
enabled = "yes"
  cell_size_m   =   nan
[[wall]]
shape = "plain"
normal = [0, 0, 1]
[[wall]]
shape = "sphere"
centre_m = [0, 0, 0]
normal = [0, 0, 1]
[boundary]
x = 1
)");
  const std::vector<std::string> expected{
      "scene.toml:4:14: run.duration_s is -1.0, expected a number above 0",
      "scene.toml:5:1: unknown key \"series_interval\" in [run] (did you mean \"series_interval_s\"?)",
      "scene.toml:6:8: run.seed is 1.5, expected a whole number at least 0",
      "scene.toml:9:11: domain.upper_m has 2 entries, expected three numbers [x, y, z]",
      "scene.toml:11:11: fluid.enabled is \"yes\", expected true or false",
      "scene.toml:12:21: fluid.cell_size_m is nan, expected a number above 0",
      "scene.toml:14:9: wall[0].shape is \"plain\" (did you mean \"plane\"?), expected one of \"plane\", \"box\"",
      "scene.toml:16:1: wall[1].radius_m is missing, expected a number above 0",
      "scene.toml:19:10: wall[1].normal does not apply here, expected only with shape = \"plane\"",
      "scene.toml:20:2: unknown key \"boundary\" at the top level"};
  ASSERT_EQ(all.size(), expected.size()) << testing::PrintToString(all);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_TRUE(all[i].starts_with(expected[i])) << all[i];
}

/// A key or the name of a table may hold anything; a message is one line.
TEST(Reader, NamesAreQuotedInMessages) {
  const auto all = mistakes_in_text(small_scene + "[materials.\"a\\nb\"]\nyoungs_modulus_Pa = -1\n" +
                                    "[measure]\n\"\\u001B[31m\" = 1\n");
  ASSERT_EQ(all.size(), 3u) << testing::PrintToString(all);
  EXPECT_TRUE(all[0].starts_with("scene.toml:16:12: materials.\"a\\u000Ab\".poisson_ratio is missing")) << all[0];
  EXPECT_TRUE(all[1].starts_with("scene.toml:17:21: materials.\"a\\u000Ab\".youngs_modulus_Pa is -1")) << all[1];
  EXPECT_TRUE(all[2].starts_with("scene.toml:19:1: unknown key \"\\u001B[31m\" in [measure]")) << all[2];
}

TEST(Reader, MissingKeysPointToTheirTable) {
  const auto all = mistakes_in_text(
      "[scene]\nname = \"x\"\n\n[run]\n[domain]\nlower_m = [0, 0, 0]\nupper_m = [1, 1, 1]\n"
      "[fluid]\nenabled = true\n");
  ASSERT_EQ(all.size(), 3u) << testing::PrintToString(all);
  EXPECT_EQ(all[0], "scene.toml:4:1: run.duration_s is missing, expected a number above 0");
  EXPECT_EQ(all[1], "scene.toml:8:1: fluid.cell_size_m is missing, expected a number above 0");
  EXPECT_EQ(all[2], "scene.toml:8:1: fluid has no liquid, expected at least one [[fluid.region]] or [[fluid.inflow]]");
}

TEST(Reader, TellsWhereAMisplacedKeyBelongs) {
  const auto all = mistakes_in_text(small_scene, {"run.smagorinsky=0.1"});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NE(all[0].find("(it belongs in [fluid])"), std::string::npos) << all[0];
}

/// A contact law is a type with members: its word makes one of it, its keys fill it.
TEST(Reader, ATypesKeysFillItAndBelongToItAlone) {
  const Scene scene = load_text(small_scene, {"solids.contact_law=linear", "solids.normal_stiffness_N_m=2e5"});
  EXPECT_EQ(scene.solids.contact_law, ContactLaw(dem::LinearSpringDashpot{2e5}));
  EXPECT_TRUE(load_text(to_toml(scene)) == scene);
  const auto missing = mistakes_in_text(small_scene, {"solids.contact_law=linear"});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_NE(missing[0].find("solids.normal_stiffness_N_m"), std::string::npos) << missing[0];
  const auto misplaced = mistakes_in_text(small_scene, {"solids.normal_stiffness_N_m=2e5"});
  ASSERT_EQ(misplaced.size(), 1u);
  EXPECT_NE(misplaced[0].find("contact_law = \"linear\""), std::string::npos) << misplaced[0];
}

TEST(Reader, TablesAndListsOfTheWrongKind) {
  EXPECT_EQ(mistakes_in_text(small_scene, {"gravity=1"}),
            std::vector<std::string>{"--set gravity=1:1:1: gravity is a whole number, expected a table"});
  EXPECT_EQ(mistakes_in_text(small_scene, {"wall.shape=plane"}),
            std::vector<std::string>{"--set wall.shape=plane:1:1: wall is a table, expected a list of tables"});
  EXPECT_EQ(mistakes_in_text(small_scene, {"wall=[1]"}),
            std::vector<std::string>{"--set wall=[1]:1:1: wall[0] is a whole number, expected a table"});
  EXPECT_EQ(mistakes_in_text(small_scene, {"materials.rock=1"}),
            std::vector<std::string>{"scene.toml:8:12: materials.rock is a whole number, expected a table"});
}

TEST(Reader, APartThatIsOffNeedsNothingButIsChecked) {
  const Scene off = load_text(small_scene + "[fluid]\nenabled = false\n[barrier]\nenabled = false\n");
  EXPECT_FALSE(off.fluid.enabled);
  EXPECT_EQ(off.fluid, Fluid{});
  EXPECT_EQ(mistakes_in_text(small_scene + "[fluid]\nenabled = false\ncell_size_m = -1\n").size(), 1u);
  EXPECT_EQ(mistakes_in_text(small_scene + "[fluid]\ncell_size_m = 1\n"),
            std::vector<std::string>{"scene.toml:16:1: fluid.enabled is missing, expected true or false"});
}

TEST(Reader, LeavesDefaultsWhereTheFileIsSilent) {
  const Scene scene = load_text(small_scene);
  EXPECT_EQ(scene.gravity, Gravity{});
  EXPECT_EQ(scene.solids, Solids{});
  EXPECT_EQ(scene.run.series_interval, 0.01);
  EXPECT_EQ(scene.materials.at(0).name, "rock");
}

}  // namespace
}  // namespace lahar::scene
