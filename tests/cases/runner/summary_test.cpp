#include "cases/runner/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

Summary example() {
  Summary s;
  s.case_name = "debris_flow";
  s.threads = 2;
  s.precision = "float";
  s.metrics = {{"front_time_s", 0.75}, {"never_s", std::nan("")}, {"mass_kg", std::numeric_limits<double>::infinity()}};
  s.checks = {{"front_time", 0.75, 0.74, 0.05, true, "theory"}, {"lost", std::nan(""), 1, 0.1, true, "nobody"}};
  s.timers = {{"fluid", 1.5}};
  s.performance = {90.5, 3e6, 1000, 20, 3};
  return s;
}

std::set<std::string> keys_of(const nlohmann::json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

TEST(Summary, HasExactlyTheFieldsOfTheContract) {
  const auto json = nlohmann::json::parse(to_json(example()));
  EXPECT_EQ(keys_of(json),
            (std::set<std::string>{"case", "version", "commit", "machine", "threads", "precision", "wall_seconds",
                                   "simulated_seconds", "metrics", "checks", "timers", "performance"}));
  EXPECT_EQ(keys_of(json["performance"]), (std::set<std::string>{"mlups", "dem_particle_steps_per_second",
                                                                 "peak_rss_bytes", "wet_cells_max", "blocks_max"}));
  EXPECT_EQ(keys_of(json["checks"][0]),
            (std::set<std::string>{"name", "value", "reference", "tolerance", "pass", "source"}));
  EXPECT_EQ(json["case"], "debris_flow");
  EXPECT_EQ(json["threads"], 2);
  EXPECT_EQ(json["timers"]["fluid"], 1.5);
  EXPECT_EQ(json["performance"]["wet_cells_max"], 20);
}

TEST(Summary, NumbersThatAreNoneNeverPass) {
  const auto json = nlohmann::json::parse(to_json(example()));
  EXPECT_EQ(keys_of(json["metrics"]), std::set<std::string>{"front_time_s"});
  EXPECT_TRUE(json["checks"][0]["pass"].get<bool>());
  EXPECT_TRUE(json["checks"][1]["value"].is_null());
  EXPECT_FALSE(json["checks"][1]["pass"].get<bool>());
}

TEST(Summary, AnEmptyOneHasEmptyListsNotNulls) {
  const auto json = nlohmann::json::parse(to_json({}));
  EXPECT_TRUE(json["metrics"].is_object());
  EXPECT_TRUE(json["checks"].is_array());
  EXPECT_TRUE(json["timers"].is_object());
}

TEST(Summary, IsWrittenWhole) {
  const scene::ScratchFolder scratch;
  write_summary(scratch.path(), example());
  EXPECT_EQ(scene::file_text(scratch.path() / "summary.json"), to_json(example()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.path()), {}), 1);  // no temporary file stays
  EXPECT_ANY_THROW(write_summary(scratch.path() / "nowhere", example()));
}

TEST(ResultsTable, ListsMetricsAndChecks) {
  const std::string table = results_table(example());
  EXPECT_NE(table.find("front_time_s"), std::string::npos);
  EXPECT_NE(table.find("(reference 0.74, pass)"), std::string::npos);
}

/// The page that everybody sees first holds the numbers of a run that is kept: rows "| `NAME`, `NAME` | 1.2, 3.4 ...
/// |".
TEST(Readme, HoldsTheNumbersOfTheDemoThatIsKept) {
  const auto kept = nlohmann::json::parse(scene::file_text(scene::source_folder() / "docs/results/runs/demo.json"));
  std::istringstream page(scene::file_text(scene::source_folder() / "README.md"));
  EXPECT_NE(page.str().find("commit " + kept["commit"].get<std::string>()), std::string::npos);
  const std::regex row("\\| (`[a-zA-Z_`, ]+`) \\| (.*) \\|"), name("`([a-zA-Z_]+)`"), number("[0-9][0-9.e-]*");
  int compared = 0;
  std::smatch cells;
  for (std::string line; std::getline(page, line);) {
    if (!std::regex_match(line, cells, row)) continue;
    const std::string names = cells[1], values = cells[2];
    auto value = std::sregex_iterator(values.begin(), values.end(), number);
    for (auto n = std::sregex_iterator(names.begin(), names.end(), name); n != std::sregex_iterator(); ++n, ++value) {
      ASSERT_NE(value, std::sregex_iterator()) << line;
      const double printed = std::stod(value->str()), measured = kept["metrics"].at((*n)[1]);
      EXPECT_NEAR(printed / measured, 1, 0.05) << line;  // as it is rounded
      ++compared;
    }
  }
  EXPECT_GE(compared, 11);
}

}  // namespace
}  // namespace lahar::cases
