// Probes and sections that do not fit the rest of the scene.
#include <gtest/gtest.h>

#include "tests/cases/assembly/rejections.h"

namespace lahar::scene {
namespace {

class Gauges : public testing::TestWithParam<Rejection> {};

TEST_P(Gauges, IsTheOneMistake) { expect_rejection(case_file("dam_break/scene.toml"), GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    CrossChecks, Gauges,
    testing::Values(
        Rejection{{"probe[0].kind=depth"},
                  "probe[0].kind",
                  "one of \"height\", \"pressure\", \"velocity\", \"force\", \"grain\""},
        Rejection{{"probe[0].position_m=[9, 0, 0]"}, "probe[0].position_m", "outside the domain"},
        Rejection{{"probe[0].wall=near_side"}, "probe[0].wall", "expected only with kind = \"force\""},
        Rejection{{"probe[0].diameter_m=0.1"}, "probe[0].diameter_m", "expected only with kind = \"pressure\""},
        Rejection{{"probe[0].kind=pressure", "probe[0].diameter_m=-1"}, "probe[0].diameter_m", "at least 0"},
        Rejection{{"probe[0].kind=pressure", "probe[0].diameter_m=100"},
                  "probe[0].diameter_m",
                  "at most the largest extent of the domain, 1.6"},
        Rejection{{"probe[0].time_mean=true"}, "probe[0].time_mean", "expected only with kind = \"pressure\""},
        Rejection{{"probe[0].kind=grain"}, "probe[0]", "without grains"},
        Rejection{{"probe[0].kind=force"}, "probe[0].wall", "is missing"},
        Rejection{{"probe[0].kind=force", "probe[0].wall=3"}, "probe[0].wall", "is a whole number"},
        Rejection{{"probe[0].kind=force", "probe[0].wall=near_sid"}, "probe[0].wall", "did you mean \"near_side\"?"},
        Rejection{{"probe[0].kind=force", "probe[0].wall=\"near\\nside\""},
                  "probe[0].wall is \"near\\u000Aside\"",
                  "did you mean \"near_side\"?"},
        Rejection{{"probe[0].kind=force", "probe[0].wall=''"}, "probe[0].wall", "the name of a [[wall]]"},
        Rejection{{"probe[0].name=time_s"}, "probe[0].name", "would write \"time_s\", a name of the program"},
        Rejection{{"probe[0].name=wet_cells"}, "probe[0].name", "\"wet_cells\", a name of the program"},
        Rejection{{"section[0].name=s", "probe[0].name=s_volume_m3", "section[0].point_m=[1, 0.1, 0.1]",
                   "section[0].normal=[1, 0, 0]"},
                  "section[0].name",
                  "\"s_volume_m3\", a name of probe[0]"},
        Rejection{{"section[0].name=s", "section[0].point_m=[1, 0.1, 0.1]"}, "section[0].normal", "is missing"},
        Rejection{{"section[0].name=s", "section[0].point_m=[1, 0.1, 0.1]", "section[0].normal=[0, 0, 0]"},
                  "section[0].normal",
                  "is zero"},
        Rejection{{"section[0].name=s", "section[0].point_m=[2, 0.1, 0.1]", "section[0].normal=[1, 0, 0]"},
                  "section[0].point_m",
                  "outside the domain"},
        Rejection{{"section[0].name=depth_1m", "section[0].point_m=[1, 0.1, 0.1]", "section[0].normal=[1, 0, 0]"},
                  "section[0].name",
                  "a name of its own"},
        Rejection{{"section[0].name=s", "section[0].point_m=[1, 0.1, 0.1]", "section[0].normal=[1, 0, 0]",
                   "section[0].width_m=-1"},
                  "section[0].width_m",
                  "at least 0"},
        Rejection{{"section[0].name=s", "section[0].point_m=[1, 0.1, 0.1]", "section[0].normal=[1, 0, 0]",
                   "section[0].height_m=tall"},
                  "section[0].height_m",
                  "is a string"}));

TEST(Gauges, AForceNeedsNoFluid) {
  const auto all = mistakes_in_text(small_scene + R"([[wall]]
name = "floor"
shape = "plane"
point_m = [0, 0, 0]
normal = [0, 0, 1]
material = "rock"
[[probe]]
name = "load"
kind = "force"
wall = "floor"
position_m = [9, 9, 9]
)");
  EXPECT_EQ(all.size(), 0u) << testing::PrintToString(all);
}

}  // namespace
}  // namespace lahar::scene
