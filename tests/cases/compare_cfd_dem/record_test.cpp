// The small records of cases.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "cases/compare_cfd_dem/record.h"
#include "cases/files/output_file.h"
#include "tests/cases/compare_cfd_dem/made_up_case.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::study {
namespace {

/// A record gives back what is shown of a case; other files beside it are left alone.
TEST(Record, HoldsWhatIsShown) {
  const cases::TestFolder folder;
  CaseResult c = made_up(4.1, 50, 10, 3);
  take_summary(c, R"({"wall_seconds": 90, "commit": "abc", "metrics": {}, "checks": [{"name": "a", "pass": false}]})",
               "a.json");
  const std::string name = shown_columns().at(1).name;
  c.curves.time_s = {0, 0.004, 0.0099999999, 0.012, 0.0301, 0.033};
  c.curves.columns = {{name, "N", "a force", {1, 2, std::nan(""), 4, 1.23456789e6, 6}}};
  write_record(c, folder.path());
  std::ofstream(folder.path() / "comparison.csv") << "quantity";
  std::ofstream(folder.path() / "notes.json") << "{}";
  const std::vector<CaseResult> found = read_records(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].study_case, c.study_case);
  EXPECT_EQ(found[0].values, c.values);
  EXPECT_EQ(found[0].wall_seconds, 90);
  ASSERT_EQ(found[0].checks.size(), 7u);
  EXPECT_EQ(found[0].checks.back().name, "a");
  EXPECT_EQ(found[0].checks.back().outcome, Outcome::failed);
  EXPECT_EQ(found[0].curves.time_s, (std::vector<double>{0, 0.01, 0.0301, 0.033}));
  const auto* column = found[0].curves.find(name);
  ASSERT_NE(column, nullptr);
  EXPECT_TRUE(std::isnan(column->values.at(1)));
  EXPECT_EQ(column->values.at(2), 1.2346e6);
  write_record(found[0], folder.path() / "again");
  EXPECT_EQ(read_records(folder.path() / "again").at(0).curves.time_s, found[0].curves.time_s);
  EXPECT_EQ(comparison_csv(found), comparison_csv({c}));
}

/// Of columns that are means since the row before a record keeps means, too: their impulse is that of all rows.
TEST(Record, KeepsMeansOfWhatAreMeans) {
  const cases::TestFolder folder;
  CaseResult c = made_up(4.1, 50, 10);
  take_summary(c, R"({"wall_seconds": 90, "metrics": {}, "checks": []})", "a.json");
  std::vector<double> force, state;
  for (int k = 0; k <= 50; ++k) {
    c.curves.time_s.push_back(0.002 * k);
    force.push_back(k % 5 == 3 ? 100 : 0);
    state.push_back(k);
  }
  c.curves.columns = {{"barrier_contact_force_x_N", "N", "", force}, {"barrier_force_sum_N", "N", "", state}};
  write_record(c, folder.path());
  const CaseResult found = read_records(folder.path()).at(0);
  const auto& time = found.curves.time_s;
  const auto& kept = found.curves.find("barrier_contact_force_x_N")->values;
  ASSERT_EQ(time.size(), 11u);
  double impulse = 0;
  for (std::size_t k = 1; k < time.size(); ++k) impulse += kept[k] * (time[k] - time[k - 1]);
  EXPECT_NEAR(impulse, 10 * 100 * 0.002, 1e-9);
  EXPECT_EQ(found.curves.find("barrier_force_sum_N")->values.at(3), 15);
}

/// What is asked for since a record was made is taken of its curves and metrics; what it holds stays.
TEST(Record, GivesWhatIsAskedForSince) {
  const cases::TestFolder folder;
  CaseResult c = made_up(4.1, 50, 10);
  take_summary(c,
               R"({"wall_seconds": 90, "checks": [],
               "metrics": {"e_in_kJ": 60, "liquid_left_kg": 3, "peak_left_cable_end_kN": 4.5}})",
               "a.json");
  c.curves.time_s = {0, 0.1, 0.2, 0.3};
  c.curves.columns = {{"barrier_force_sum_N", "N", "", {0, 1000, 2000, 3000}}};
  write_record(c, folder.path());
  const CaseResult found = read_records(folder.path()).at(0);
  EXPECT_EQ(found.value("water_left"), 3);
  EXPECT_NEAR(found.value("barrier_sum_mean"), 2, 1e-12);
  EXPECT_EQ(found.value("e_in"), 50);
  EXPECT_EQ(found.value("left_cable_end"), 4.5);
  EXPECT_TRUE(std::isnan(found.value("right_cable_end"))) << "no such metric";
  EXPECT_TRUE(std::isnan(found.value("e_b_axial"))) << "records hold no such column";
}

/// The mass of the grains follows from the energies about two beds, and with it what is over E_in.
TEST(Record, KnowsTheMassOfTheGrains) {
  const cases::TestFolder folder;
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", 4.1, 1};
  run.metrics = {{"e_in_kJ", 50}, {"liquid_mass_start_kg", 500}, {"e_out_liquid_kinetic_kJ", 3}};
  run.grain_mass = 1100;
  CaseResult c = result_of(run);
  EXPECT_NEAR(mass_by_energies(c.value("e_in"), c.value("e_in_lower")), 1600, 1e-9);
  const double share = c.value("out_liquid_kinetic");
  ASSERT_TRUE(std::isfinite(share));
  c.values.erase("out_liquid_kinetic");
  take_summary(c,
               R"({"wall_seconds": 90, "metrics": {"e_in_kJ": 50, "liquid_mass_start_kg": 500,
               "e_out_liquid_kinetic_kJ": 3}, "checks": []})",
               "a.json");
  write_record(c, folder.path());
  EXPECT_NEAR(read_records(folder.path()).at(0).value("out_liquid_kinetic"), share, 1e-12);
}

/// Of a record and a run of other commits the later one stays; where one has no date the run.
TEST(Record, TheLaterOneStays) {
  const auto of = [](const char* commit, const char* ended, double e_in) {
    CaseResult c = made_up(4.1, e_in, 10);
    take_summary(c, fmt::format(R"({{"wall_seconds": 90, "metrics": {{}}, "checks": [], "commit": "{}"}})", commit),
                 "a.json");
    c.ended = ended;
    return c;
  };
  const auto left = [&](const char* theirs, const char* ours) {
    const cases::TestFolder folder;
    write_record(of("theirs", theirs, 50), folder.path());
    CaseResult run = of("ours", ours, 60);
    run.folder = folder.path();
    const double told = share({run}, folder.path()).at(0).value("e_in");
    EXPECT_EQ(read_records(folder.path()).at(0).value("e_in"), told);
    return told;
  };
  EXPECT_EQ(left("2026-01-31T12:00:00Z", "2026-01-31T11:59:59Z"), 50);
  EXPECT_EQ(left("2026-01-31T12:00:00Z", "2026-02-01T00:00:00Z"), 60);
  EXPECT_EQ(left("", "2026-02-01T00:00:00Z"), 60);
  EXPECT_EQ(left("2026-01-31T12:00:00Z", ""), 60);
  const cases::TestFolder folder;
  write_record(of("theirs", "", 50), folder.path());
  EXPECT_EQ(share({}, folder.path()).size(), 1u);
}

TEST(Record, FilesThatAreNoneAreNamed) {
  const cases::TestFolder folder;
  EXPECT_TRUE(read_records(folder.path() / "none").empty());
  const std::filesystem::path file = folder.path() / (made_up(4.1, 50, 10).study_case.name() + ".json");
  for (const char* text :
       {"", "{}", R"({"summary": {"wall_seconds": 1, "checks": []}, "values": {}, "curves": {"time_s": [0],
           "barrier_elongation_m": [1, 2]}})"}) {
    std::ofstream(file) << text;
    try {
      (void)read_records(folder.path());
      FAIL() << text;
    } catch (const cases::FileError& e) {
      EXPECT_EQ(e.path(), file);
    }
  }
}

}  // namespace
}  // namespace lahar::study
