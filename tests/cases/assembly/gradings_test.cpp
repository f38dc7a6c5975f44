#include <gtest/gtest.h>

#include <ctime>
#include <numbers>
#include <numeric>

#include "cases/assembly/estimates.h"
#include "cases/assembly/grain_sizes.h"
#include "cases/scene/writer.h"
#include "tests/cases/assembly/rejections.h"

namespace lahar::scene {
namespace {

const std::filesystem::path kScene = case_file("graded_gravel/scene.toml");

std::string curve(const std::string& points) { return "grains.packing[0].sieve_curve[0].passing_percent=" + points; }

/// A log-normal grading in place of the sieve curve.
std::vector<std::string> log_normal(const std::string& keys) {
  return {"grains.packing[0].sieve_curve=[]",
          "grains.packing[0].log_normal=[{density_kg_m3=2650.0, material='rock', " + keys + "}]"};
}

double volume_of(const std::vector<GrainSize>& sizes, double low, double high) {
  double volume = 0;
  for (const GrainSize& s : sizes)
    if (s.diameter >= low && s.diameter < high)
      volume += static_cast<double>(s.count) * std::numbers::pi / 6 * std::pow(s.diameter, 3);
  return volume;
}

/// Asked: 0.64 of 0.2 x 0.2 x 0.15 m, 40 % below 16 mm; each fraction within 1.5 of its largest grains
/// (dem/packing/grading.h).
TEST(Gradings, SieveCurveFillsThePackingFractionByFraction) {
  const Scene scene = load(kScene);
  const std::vector<GrainSize> sizes = grain_sizes(scene, 0);
  const double asked = 0.64 * 0.2 * 0.2 * 0.15;
  EXPECT_NEAR(volume_of(sizes, 0.008, 0.016), 0.4 * asked, 1.5 * std::numbers::pi / 6 * std::pow(0.016, 3));
  EXPECT_NEAR(volume_of(sizes, 0.016, 0.0315), 0.6 * asked, 1.5 * std::numbers::pi / 6 * std::pow(0.0315, 3));
  EXPECT_EQ(static_cast<std::int64_t>(sizes.size()), cases::grain_count(scene));
  EXPECT_GE(cases::smallest_grain(scene), 0.008);
  EXPECT_LT(cases::smallest_grain(scene), 0.0081);
  for (const GrainSize& s : sizes) {
    EXPECT_EQ(s.density, 2650);
    EXPECT_EQ(s.material, "rock");
  }
}

TEST(Gradings, MassIsTakenWhereItIsGiven) {
  const Scene scene = load(kScene, {"grains.packing[0].sieve_curve[0].mass_kg=2.65"});
  EXPECT_NEAR(volume_of(grain_sizes(scene, 0), 0, 1), 1e-3, 3 * std::numbers::pi / 6 * std::pow(0.0315, 3));
}

TEST(Gradings, ListedSizesComeFirst) {
  const Scene scene =
      load(kScene, {"grains.packing[0].sizes=[{diameter_m=0.05, count=3, density_kg_m3=2700.0, material='rock'}]"});
  const auto sizes = grain_sizes(scene, 0);
  EXPECT_EQ(sizes[0].count, 3);
  EXPECT_EQ(sizes[1].count, 1);
  EXPECT_EQ(cases::grain_count(scene), static_cast<std::int64_t>(sizes.size()) + 2);
}

TEST(Gradings, AreFixedBySeedAndDifferBetweenTables) {
  const Scene one = load(kScene), other = load(kScene, {"run.seed=2"});
  EXPECT_EQ(grain_sizes(one, 0), grain_sizes(one, 0));
  EXPECT_NE(grain_sizes(one, 0), grain_sizes(other, 0));
  Scene twice = one;
  twice.grains.packings.push_back(one.grains.packings[0]);
  EXPECT_NE(grain_sizes(twice, 0), grain_sizes(twice, 1));
  EXPECT_EQ(grain_sizes(twice, 0), grain_sizes(one, 0));
  Packing& first = twice.grains.packings[0];  // its second table against the first one of the second packing
  first.sieved.push_back(first.sieved[0]);
  const std::vector<GrainSize> both = grain_sizes(twice, 0), next = grain_sizes(twice, 1);
  EXPECT_NE(std::vector<GrainSize>(both.begin() + std::ssize(grain_sizes(one, 0)), both.end()), next);
}

/// A check asks a dozen times for the grains of a packing: they are drawn once.
TEST(Gradings, AreDrawnOnce) {
  const Scene scene = load(kScene, log_normal("median_diameter_m=0.0006, log_deviation=0.3, smallest_diameter_m=4e-4, "
                                              "largest_diameter_m=1e-3, mass_kg=0.04, weighting=\"mass\""));
  Scene fresh = scene;
  fresh.run.seed = 17;
  const auto seconds_of = [&](int times) {  // of the processor
    const std::clock_t start = std::clock();
    for (int k = 0; k < times; ++k) EXPECT_GT(grain_sizes(fresh, 0).size(), 50'000u);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  const double drawn = seconds_of(1);
  EXPECT_LT(seconds_of(20), 10 * drawn);
}

TEST(Gradings, LogNormalCountsMassOrGrains) {
  const std::string keys =
      "median_diameter_m=0.015, log_deviation=0.3, smallest_diameter_m=0.006, "
      "largest_diameter_m=0.04, weighting=";
  const auto mass = grain_sizes(load(kScene, log_normal(keys + "'mass'")), 0);
  const auto number = grain_sizes(load(kScene, log_normal(keys + "'number'")), 0);
  // Cut off at three deviations or more: the medians stay to within a percent of the share.
  EXPECT_NEAR(volume_of(mass, 0, 0.015) / volume_of(mass, 0, 1), 0.5, 0.01);
  const auto below = std::count_if(number.begin(), number.end(), [](const GrainSize& s) { return s.diameter < 0.015; });
  EXPECT_NEAR(static_cast<double>(below) / static_cast<double>(number.size()), 0.5, 0.01);
  EXPECT_GT(mass.size(), number.size());
}

TEST(Gradings, TheResolvedSceneDrawsTheSameGrains) {
  const Scene scene = load(kScene, {"run.seed=5"});
  const ScratchFolder folder;
  const Scene again = load(folder.write("again.toml", to_toml(scene)), {});
  EXPECT_EQ(again, scene);
  EXPECT_EQ(grain_sizes(again, 0), grain_sizes(scene, 0));
}

class GradingMistake : public testing::TestWithParam<Rejection> {};

TEST_P(GradingMistake, IsTheOneMistake) { expect_rejection(kScene, GetParam()); }

const std::string kCurve = "grains.packing[0].sieve_curve[0]", kLog = "grains.packing[0].log_normal[0]";

Rejection of_curve(const std::string& points, const std::string& part) {
  return {{curve(points)}, kCurve + ".passing_percent", part};
}

Rejection of_log(const std::string& keys, const std::string& key, const std::string& part) {
  return {log_normal(keys), kLog + key, part};
}

INSTANTIATE_TEST_SUITE_P(
    Gradings, GradingMistake,
    testing::Values(
        of_curve("[[0.008, 0], [0.016, 60], [0.02, 40], [0.0315, 100]]", "falls from 60 to 40 at the opening 0.02"),
        of_curve("[[0.016, 0], [0.008, 100]]", "has the opening 0.008 after 0.016"),
        of_curve("[[0.016, 0], [0.016, 100]]", "expected rising openings"),
        of_curve("[[0, 0], [0.016, 100]]", "has entry 1 with the opening 0"),
        of_curve("[[0.008, 5], [0.016, 100]]", "begins with 5 percent"),
        of_curve("[[0.008, 0], [0.016, 90]]", "ends with 90 percent"), of_curve("[[0.008, 0]]", "has 1 entries"),
        of_curve("[[0.008, 0], [0.016, 101]]", "which has a percentage"),
        of_curve("[[0.008, 0], [0.016]]", "has entry 2"),
        of_curve("[[0.008, 0], [0.3, 100]]", "smallest extent of the box, 0.2"),
        of_curve("[[0.008, 0], [0.016, 99.95], [0.18, 100]]", "the fraction from 0.016 to 0.18 m holds"),
        of_curve("[[1e-4, 0], [0.016, 100]]", "expected at most 1e+06"),
        Rejection{{"grains.packing[0].target_height_m=0"}, kCurve + ".mass_kg", "expected one of the two"},
        Rejection{{kCurve + ".mass_kg=-1"}, kCurve + ".mass_kg", "at least 0"},
        Rejection{{kCurve + ".mass_kg=60"}, "grains.packing[0]: grains fill", "at most 0.74"},
        Rejection{{kCurve + ".solid_fraction=0.8"}, kCurve + ".solid_fraction", "at most 0.74"},
        Rejection{{kCurve + ".density_kg_m3=0"}, kCurve + ".density_kg_m3", "above 0"},
        Rejection{{kCurve + ".material=rok"}, kCurve + ".material", "did you mean \"rock\""},
        Rejection{{"fluid={enabled=true, cell_size_m=0.01, max_speed_m_s=2.0, region=[{shape='box', lower_m=[0.5, 0, "
                   "0], upper_m=[0.9, 0.2, 0.1]}]}",
                   "coupling={enabled=true}"},
                  kCurve + ".passing_percent",
                  "at least a cell of the fluid, 0.01"},
        of_log("median_diameter_m=0, log_deviation=0.3, smallest_diameter_m=0.01, largest_diameter_m=0.02",
               ".median_diameter_m", "above 0"),
        of_log("median_diameter_m=0.015, log_deviation=0, smallest_diameter_m=0.01, largest_diameter_m=0.02",
               ".log_deviation", "above 0"),
        of_log("median_diameter_m=0.015, log_deviation=0.3, smallest_diameter_m=0, largest_diameter_m=0.02",
               ".smallest_diameter_m", "above 0"),
        of_log("median_diameter_m=0.015, log_deviation=0.3, smallest_diameter_m=0.02, largest_diameter_m=0.02",
               ".largest_diameter_m", "above smallest_diameter_m"),
        of_log("median_diameter_m=0.015, log_deviation=0.3, smallest_diameter_m=0.01, largest_diameter_m=0.25",
               ".largest_diameter_m", "smallest extent of the box, 0.2"),
        of_log("median_diameter_m=0.015, log_deviation=0.1, smallest_diameter_m=0.05, largest_diameter_m=0.06",
               ": the cut-offs keep", "expected at least 0.01"),
        of_log("median_diameter_m=0.015, log_deviation=0.3, smallest_diameter_m=0.01, largest_diameter_m=0.02, "
               "weighting='volume'",
               ".weighting", "one of \"mass\", \"number\""),
        of_log("median_diameter_m=0.1, log_deviation=0.3, smallest_diameter_m=0.05, largest_diameter_m=0.19, "
               "mass_kg=0.01",
               ": the distribution holds", "of a grain")));

/// Cells may be as coarse as the averages are long: grains below a cell feel the water by a drag law.
TEST(Gradings, AveragedGrainsMayBeSmallerThanCells) {
  const std::string fluid =
      "fluid={enabled=true, cell_size_m=0.01, max_speed_m_s=2.0, region=[{shape='box', lower_m=[0.5, 0, 0], "
      "upper_m=[0.9, 0.2, 0.1]}]}";
  EXPECT_NO_THROW(load(kScene, {fluid, "coupling={enabled=true, grains='averaged', averaging_length_m=0.1}"}));
}

}  // namespace
}  // namespace lahar::scene
