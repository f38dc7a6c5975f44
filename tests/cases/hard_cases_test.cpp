#include "cases/hard_cases/hard_cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cases/validate/reference_table.h"
#include "tests/cases/scene/scene_files.h"
#include "tests/cases/validate/known_misses.h"

namespace lahar::validate {
namespace {

TEST(HardCases, AreAllThatAreListed) {
  std::set<std::string> ids;
  for (const HardCase& c : hard_cases()) {
    EXPECT_TRUE(ids.insert(c.id).second) << c.id << " twice";
    EXPECT_FALSE(c.question.empty()) << c.id;
    EXPECT_FALSE(c.criterion.empty()) << c.id;
    EXPECT_FALSE(c.entries.empty()) << c.id;
    EXPECT_EQ(select_entries(all_entries(), c.entries).size(), c.entries.size()) << c.id;
  }
  for (int k = 1; k <= 20; ++k) EXPECT_EQ(ids.count(fmt::format("H{}", k)), 1u) << k;
  EXPECT_EQ(reference("hard_cases.csv").size(), 20u);
}

/// Entries that bear the number of a hard case in their alias belong to it.
TEST(HardCases, HoldTheEntriesThatBearTheirNumber) {
  std::set<std::string> held;
  for (const HardCase& c : hard_cases()) held.insert(c.entries.begin(), c.entries.end());
  int numbered = 0;
  for (const Entry& e : all_entries())
    if (e.alias.find("hard_h") != std::string::npos) {
      EXPECT_EQ(held.count(e.name), 1u) << e.name << " (" << e.alias << ")";
      ++numbered;
    }
  EXPECT_GE(numbered, 20);
}

TEST(HardCases, AreChosenByTheirIds) {
  const auto chosen = select_hard_cases({"L5", "H3"});
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[0].id, "H3");
  EXPECT_EQ(chosen[1].id, "L5");
  EXPECT_EQ(select_hard_cases({}).size(), hard_cases().size());
  EXPECT_THROW(select_hard_cases({"H21"}), std::invalid_argument);
}

/// tools/results_page reads the cases from the source: none may escape it.
TEST(HardCases, StandOnTheResultsPageWithTheirEntries) {
  const std::string page = scene::file_text(scene::source_folder() / "docs/results.md");
  for (const HardCase& c : hard_cases()) {
    const std::string row = fmt::format("\n| {} | {} | `{}` | ", c.id, c.question, fmt::join(c.entries, "`, `"));
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

std::vector<std::string> all_ids() {
  std::vector<std::string> ids;
  for (const HardCase& c : hard_cases()) ids.push_back(c.id);
  return ids;
}

TEST(KnownMisses, AreOfEntriesAndOfTheirValues) {
  for (const auto& [row, known] : known_misses()) {
    EXPECT_EQ(select_entries(all_entries(), {row.first}).size(), 1u) << row.first;
    EXPECT_LT(known.lowest, known.highest) << row.second;
  }
  const std::string label = "discharge over A sqrt(2 g h), 0.55 to 0.70";
  const auto knows = [&](const char* name, double discharge) {
    return is_known_miss(name, absolute_row(label, discharge, 0.625, 0.075));
  };
  EXPECT_TRUE(knows("free_surface.orifice_jet", 0.72));
  for (const double discharge : {0.0, 0.8, std::nan("")})
    EXPECT_FALSE(knows("free_surface.orifice_jet", discharge)) << discharge;
  EXPECT_FALSE(knows("free_surface.trapped_gas", 0.72));
}

/// Coarser grids and fewer steps than bin/hard_cases.
class QuickHardCase : public testing::TestWithParam<std::string> {};

TEST_P(QuickHardCase, MissesNothingNew) {
  Context context;
  context.quick = true;
  const HardCaseResult result = run_hard_case(select_hard_cases({GetParam()}).at(0), context);
  ASSERT_FALSE(result.outcomes.empty());
  for (const Outcome& o : result.outcomes) {
    EXPECT_EQ(o.failure, "") << o.name;
    EXPECT_FALSE(o.rows.empty()) << o.name;
    for (const Row& row : o.rows)
      EXPECT_TRUE(row.pass || is_known_miss(o.name, row)) << o.name << ": " << row.label << " " << row.value;
  }
}

INSTANTIATE_TEST_SUITE_P(HardCases, QuickHardCase, testing::ValuesIn(all_ids()),
                         [](const testing::TestParamInfo<std::string>& one) { return one.param; });

Outcome outcome(const char* name, std::vector<Row> rows) {
  Outcome o;
  o.name = name, o.rows = std::move(rows), o.seconds = 1.5;
  return o;
}

TEST(HardCases, PassWhereAllRowsOfAllEntriesDo) {
  HardCaseResult result{{"H1", "water, oil", "none lost", {"a.b", "a.c"}}, {}};
  EXPECT_FALSE(result.pass());  // nothing was run
  result.outcomes = {outcome("a.b", {at_most_row("drift", 1e-7, 1e-6)})};
  EXPECT_TRUE(result.pass());
  result.outcomes.push_back(
      outcome("a.c", {at_most_row("drift", 1e-7, 1e-6), relative_row("front", 1.2, 1, 0.1), note_row("neck", 0.4)}));
  EXPECT_FALSE(result.pass());
  EXPECT_EQ(result.seconds(), 3);
  const std::string text = result_text(result);
  EXPECT_NE(text.find("SHORT    2 of 3"), std::string::npos) << text;
  EXPECT_NE(text.find("a.c: front: 1.2, error 0.2, bar 0.1"), std::string::npos) << text;
}

TEST(HardCases, WriteARowForEachFigure) {
  HardCaseResult result{{"H1", "water, oil", "none lost", {"a.b"}},
                        {outcome("a.b", {at_most_row("drift", 1e-7, 1e-6), relative_row("front", 1.2, 1, 0.1),
                                         at_most_row("the \"wet\" part, m", 1, 2), note_row("neck", 0.4)})}};
  result.outcomes[0].failure = "not a number";
  const std::string csv = results_csv({result}, {.quick = true, .plots = {}}, "2020-02-29");
  const ReferenceTable table = ReferenceTable::parse(csv, "hard_cases.csv");
  EXPECT_NE(table.provenance().at(0).find("2020-02-29, quick form, double"), std::string::npos);
  EXPECT_NE(results_csv({}, {.precision = Precision::float32, .plots = {}}, "").find(", full form, float\n"),
            std::string::npos);
  EXPECT_EQ(table.size(), 5u);
  EXPECT_EQ(table.where("row", "the \"wet\" part, m").number("value"), 1);
  EXPECT_EQ(table.where("row", "drift").text("pass"), "true");
  EXPECT_EQ(table.where("row", "front").text("pass"), "false");
  EXPECT_EQ(table.where("row", "front").number("error"), 0.2);
  EXPECT_EQ(table.where("row", "not a number").text("pass"), "false");
  EXPECT_EQ(table.where("row", "drift").text("case"), "water, oil");
  EXPECT_EQ(table.where("row", "neck").number("value"), 0.4);
  for (const char* column : {"reference", "error", "tolerance", "pass"})
    EXPECT_EQ(table.where("row", "neck").text(column), "-") << column;
}

}  // namespace
}  // namespace lahar::validate
