#include "cases/scene/writer.h"

#include <gtest/gtest.h>

#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {
namespace {

void expect_round_trip(const Scene& scene) {
  const std::string text = to_toml(scene);
  const Scene back = load_text(text);
  EXPECT_TRUE(back == scene) << text;
  EXPECT_EQ(to_toml(back), text);
}

class CaseFile : public testing::TestWithParam<std::string> {};

TEST_P(CaseFile, ResolvedSceneLoadsAsTheSameScene) { expect_round_trip(load(case_file(GetParam()))); }

INSTANTIATE_TEST_SUITE_P(Writer, CaseFile, testing::ValuesIn(scene_files()), name_of_test);

TEST(Writer, EveryShapeAndAwkwardTextSurvive) {
  const Scene scene = load_text(small_scene + R"(
[materials."odd name.\"x\""]
youngs_modulus_Pa = 0.1
poisson_ratio = 0.3333333333333333
[measure]
section_x_m = 0.5
[[wall]]
name = "tab\tand \"quotes\" \\ \u00fc"
shape = "cylinder"
start_m = [0, 0, 0]
end_m = [0, 0, 1]
radius_m = 0.1
material = "odd name.\"x\""
[[wall]]
shape = "box"
lower_m = [0.9, 0.9, 0]
upper_m = [1, 1, 1]
velocity_m_s = [0, 0, 1e-7]
material = "rock"
[[wall]]
shape = "sphere"
centre_m = [0, 1, 0]
radius_m = 0.1
material = "rock"
)",
                                {"measure.inflow_distance_m=0.1", "measure.outflow_distance_m=0.1"});
  ASSERT_EQ(scene.walls.size(), 3u);
  EXPECT_EQ(scene.walls[0].name, "tab\tand \"quotes\" \\ \xc3\xbc");
  EXPECT_EQ(scene.measure.section_x, 0.5);
  expect_round_trip(scene);
}

TEST(Writer, StartsWithTheMarkOfAResolvedScene) {
  EXPECT_TRUE(to_toml(load_text(small_scene)).starts_with(resolved_mark));
}

TEST(Writer, OverridesAreInTheResolvedScene) {
  const Scene scene = load_text(small_scene, {"run.duration_s=0.125"});
  EXPECT_NE(to_toml(scene).find("duration_s = 0.125\n"), std::string::npos);
}

TEST(Writer, EveryDefaultIsFilledIn) {
  const std::string text = to_toml(load_text(small_scene));
  for (const char* line : {"magnitude_m_s2 = 9.81\n", "series_interval_s = 0.01\n", "precision = \"float\"\n",
                           "contact_safety = 0.14\n", "[fluid]\nenabled = false\n", "fixed = false\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line;
}

}  // namespace
}  // namespace lahar::scene
