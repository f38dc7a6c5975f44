#include "cases/assembly/cross_checks.h"

#include <gtest/gtest.h>

#include "tests/cases/assembly/rejections.h"

namespace lahar::scene {
namespace {

class NamesAndMaterials : public testing::TestWithParam<Rejection> {};

TEST_P(NamesAndMaterials, IsTheOneMistake) { expect_rejection(case_file("debris_flow/scene.toml"), GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    CrossChecks, NamesAndMaterials,
    testing::Values(
        Rejection{{"scene.name='a/b'"}, "scene.name", "letters, digits"},
        Rejection{{"scene.name=''"}, "scene.name", "letters"},
        Rejection{{"scene.title=\"two\\nlines\""}, "scene.title", "holds a control character"},
        Rejection{{"scene.title=\"\\u009B31m\""}, "scene.title", "holds a control character"},
        Rejection{{"wall[0].material=wal"}, "wall[0].material", "did you mean \"wall\"?"},
        Rejection{{"wall[0].material=''"}, "wall[0].material", "expected the name of a table"},
        Rejection{{"contact[0].materials=['rock', 'stee']"}, "contact[0].materials", "did you mean \"steel\"?"},
        Rejection{{"contact[1].materials=['rock', 'rock']"}, "contact[1].materials", "each pair once"},
        Rejection{{"contact[4].materials=['steel', 'rock']"}, "contact[4].materials", "each pair once"},
        Rejection{{"grains.packing[0].sizes[1].material=granite"}, "grains.packing[0].sizes[1].material", "expected"},
        Rejection{{"barrier.net.material=steal"}, "barrier.net.material", "did you mean \"steel\"?"},
        Rejection{{"probe[0].name='a b'", "probe[0].kind=height", "probe[0].position_m=[1, 1, 0]"},
                  "probe[0].name",
                  "letters"},
        Rejection{{"probe[0].name=a", "probe[0].kind=height", "probe[0].position_m=[1, 1, 0]", "probe[1].name=a",
                   "probe[1].kind=pressure", "probe[1].position_m=[1, 1, 0]"},
                  "probe[1].name",
                  "again"},
        Rejection{{"scene.name=\"a\\nb\""}, "scene.name is \"a\\u000Ab\"", "letters, digits"},
        Rejection{{"wall[0].material=\"\\u001B[31m\""}, "wall[0].material is \"\\u001B[31m\"", "the name of a table"},
        Rejection{{"wall[0].name=\"a\\nb\"", "wall[1].name=\"a\\nb\""}, "wall[1].name is \"a\\u000Ab\" again", "own"}));

TEST(CrossChecks, WallsNeedNoMaterialWithoutSolids) {
  EXPECT_TRUE(mistakes_in(case_file("dam_break/scene.toml")).empty());
  EXPECT_EQ(mistakes_in(case_file("dam_break/scene.toml"), {"wall[0].material=x"}).size(), 1u);
}

TEST(CrossChecks, MoreMaterialsThanContactsTellApart) {
  std::vector<std::string> set;
  for (int k = 0; k < 1000; ++k) {
    set.push_back("materials.m" + std::to_string(k) + ".youngs_modulus_Pa=1e9");
    set.push_back("materials.m" + std::to_string(k) + ".poisson_ratio=0.3");
  }
  const auto all = mistakes_in(case_file("bouncing_sphere/scene.toml"), set);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NE(all[0].find("tables, expected at most 181"), std::string::npos) << all[0];
}

TEST(CrossChecks, AMistakeDoesNotBreedOthers) {
  // The domain is unreadable: nothing is said about what lies outside of it.
  EXPECT_EQ(mistakes_in(case_file("debris_flow/scene.toml"), {"domain.upper_m=[1, 2]"}).size(), 1u);
  EXPECT_EQ(mistakes_in(case_file("debris_flow/scene.toml"), {"barrier.net.ring_pitch_m=nan"}).size(), 1u);
}

TEST(CrossChecks, MistakesOfAllKindsAreReportedTogether) {
  const auto all = mistakes_in(case_file("debris_flow/scene.toml"),
                               {"run.duration_s=-1", "barrier.net.material=steal", "measure.outflow_distance_m=100",
                                "run.sede=1", "fluid.region[0].upper_m=[9, 1, 1]"});
  EXPECT_EQ(all.size(), 5u) << testing::PrintToString(all);
}

}  // namespace
}  // namespace lahar::scene
