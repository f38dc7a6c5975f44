// What of a case is chance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cases/compare_cfd_dem/over_seeds.h"
#include "tests/cases/compare_cfd_dem/made_up_case.h"

namespace lahar::study {
namespace {

CaseResult packing(const char* coupling, int seed, double e_in, const char* commit = "aaa") {
  CaseResult c = made_up(4.1, e_in, 10, seed);
  c.study_case.preset = "strip", c.study_case.coupling = coupling, c.commit = commit;
  return c;
}

const OverSeeds* energy_of(const std::vector<OverSeeds>& all, const std::string& coupling) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const OverSeeds& s) { return s.quantity == "e_in" && s.coupling == coupling; });
  return found == all.end() ? nullptr : &*found;
}

/// Resolved 40 +- 1 kJ of three, averaged 44 +- 2 kJ of two: 10 % more, with an error of the ratio by both.
TEST(OverSeeds, SayWhatAveragingChangesAndHowWellThatIsKnown) {
  const std::vector<OverSeeds> all =
      over_seeds({packing("resolved", 1, 39), packing("resolved", 2, 40), packing("resolved", 3, 41),
                  packing("averaged", 1, 44 - std::sqrt(2)), packing("averaged", 2, 44 + std::sqrt(2))});
  const OverSeeds *resolved = energy_of(all, "resolved"), *averaged = energy_of(all, "averaged");
  ASSERT_TRUE(resolved && averaged);
  EXPECT_EQ(resolved->seeds, 3u);
  EXPECT_NEAR(resolved->mean, 40, 1e-12);
  EXPECT_NEAR(resolved->deviation, 1, 1e-12);
  EXPECT_TRUE(std::isnan(resolved->change));
  EXPECT_EQ(averaged->seeds, 2u);
  EXPECT_NEAR(averaged->deviation, 2, 1e-12);
  EXPECT_NEAR(averaged->change, 0.1, 1e-12);
  EXPECT_NEAR(averaged->change_error, std::sqrt(2.0 * 2 / 2 + 1.1 * 1.1 * 1 / 3) / 40, 1e-12);
  EXPECT_NE(over_seeds_csv(all).find("e_in,kJ,matched,strip,4.10,averaged,2,44,2,0.1,"), std::string::npos)
      << over_seeds_csv(all);
}

/// Runs of several programs are not taken together, nor single ones, nor those of changes that no commit holds.
TEST(OverSeeds, AreOfOneProgram) {
  std::vector<CaseResult> results{packing("resolved", 1, 39), packing("resolved", 2, 41, "bbb")};
  EXPECT_TRUE(over_seeds(results).empty());
  results.push_back(packing("resolved", 3, 43, "bbb"));
  results.push_back(packing("averaged", 1, 44)), results.push_back(packing("averaged", 2, 46));
  const std::vector<OverSeeds> all = over_seeds(results);
  ASSERT_TRUE(energy_of(all, "resolved") && energy_of(all, "averaged"));
  EXPECT_EQ(energy_of(all, "resolved")->commit, "bbb");
  EXPECT_EQ(energy_of(all, "resolved")->mean, 42);
  EXPECT_TRUE(std::isnan(energy_of(all, "averaged")->change)) << "of another program than the resolved ones";
  for (CaseResult& c : results) c.commit = "aaa-dirty";
  EXPECT_TRUE(over_seeds(results).empty());
}

/// Nor is a reading of the net a seed.
TEST(OverSeeds, LeaveOtherReadingsOut) {
  std::vector<CaseResult> results{packing("resolved", 1, 39), packing("resolved", 1, 41)};
  results.back().study_case.variant = "rockfall_dissipators";
  EXPECT_TRUE(over_seeds(results).empty());
}

}  // namespace
}  // namespace lahar::study
