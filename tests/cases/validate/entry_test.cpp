// The ladder's own machinery.
#include "cases/validate/entry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "cases/validate/fluid/flows.h"
#include "cases/validate/free_surface/pulse.h"
#include "cases/validate/grains_in_fluid/hard_spheres.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {
namespace {

/// A grid on which the numbers went wrong has no order.
TEST(LowestOrder, OfNumbersThatWentWrongIsNone) {
  const int cells[] = {8, 16, 32};
  const double nan = std::nan("");
  EXPECT_NEAR(lowest_order(cells, std::vector<double>{0.16, 0.04, 0.02}), 1, 1e-12);
  EXPECT_FALSE(lowest_order(cells, std::vector<double>{nan, 0.04, 0.01}) >= 1.9);
  EXPECT_FALSE(lowest_order(cells, std::vector<double>{0.16, 0.04, nan}) >= 1.9);
}

Entry entry(const std::string& name, std::vector<Row> rows) {
  return {name, {"here", {"a.csv", "b.csv"}}, [rows](const Context&) { return rows; }};
}

const std::vector<Entry> kSome = {entry("fluid.one", {absolute_row("x", 1, 1, 0)}), entry("fluid.two", {}),
                                  entry("solids.one", {absolute_row("x", 2, 1, 0.5)})};

TEST(ValidateSelection, TakesNamesGroupsAndAll) {
  EXPECT_EQ(select_entries(kSome, {}).size(), 3u);
  EXPECT_EQ(select_entries(kSome, {"fluid"}).size(), 2u);
  const auto chosen = select_entries(kSome, {"solids.one", "fluid.one"});
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[0].name, "fluid.one");  // in the order of the ladder
}

TEST(ValidateSelection, KnowsAliasesAndTheirGroups) {
  std::vector<Entry> some = kSome;
  some[2].alias = "fluid.three";
  EXPECT_EQ(select_entries(some, {"fluid.three"}).at(0).name, "solids.one");
  EXPECT_EQ(select_entries(some, {"fluid"}).size(), 3u);
  EXPECT_EQ(select_entries(some, {"solids"}).size(), 1u);
  EXPECT_EQ(run_entry(some[2], {}).alias, "fluid.three");
}

TEST(ValidateSelection, RefusesUnknownNamesWithTheNearest) {
  try {
    (void)select_entries(kSome, {"fluid.tow"});
    FAIL() << "fluid.tow is no entry";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("fluid.two"), std::string::npos) << e.what();
  }
}

TEST(ValidateRows, PassOnlyWithinTheirBars) {
  EXPECT_TRUE(relative_row("", 1.04, 1, 0.05).pass);
  EXPECT_FALSE(relative_row("", 1.06, 1, 0.05).pass);
  EXPECT_FALSE(relative_row("", std::nan(""), 1, 0.05).pass);
  EXPECT_TRUE(at_least_row("", 1.9, 1.9).pass);
  EXPECT_FALSE(at_least_row("", std::nan(""), 1.9).pass);
  EXPECT_FALSE(at_most_row("", 2, 1.9).pass);
  EXPECT_DOUBLE_EQ(at_least_row("", 1.5, 1.9).error, 1.9 - 1.5);
}

/// A note is neither reached nor missed, unless it is no number.
TEST(ValidateRows, WithoutABarAreNotes) {
  const Row bar = at_most_row("x", 1, 2), note = note_row("y", 3), broken = note_row("y", std::nan(""));
  const Outcome both = run_entry(entry("fluid.both", {bar, note}), {});
  EXPECT_TRUE(both.pass());
  EXPECT_EQ(both.asked(), 1u);
  EXPECT_EQ(both.reached(), 1u);
  EXPECT_FALSE(run_entry(entry("fluid.notes", {note}), {}).pass());  // nothing was asked
  EXPECT_FALSE(run_entry(entry("fluid.broken", {bar, broken}), {}).pass());
  EXPECT_EQ(figure_text(note, note.tolerance, 3), "-");
  EXPECT_EQ(figure_text(bar, bar.tolerance, 3), "2");
  EXPECT_EQ(outcome_text(both).find("nan"), std::string::npos) << outcome_text(both);
  const auto rows = nlohmann::json::parse(outcomes_json({both}, {}))["entries"][0]["rows"];
  EXPECT_FALSE(rows[0].contains("note"));
  EXPECT_EQ(rows[1]["note"], true);
  EXPECT_EQ(rows[1]["value"], 3.0);
  EXPECT_TRUE(rows[1]["tolerance"].is_null() && rows[1]["error"].is_null() && rows[1]["reference"].is_null());
}

TEST(ValidateOutcome, NeedsRowsThatAllPassAndNoFailure) {
  EXPECT_TRUE(run_entry(kSome[0], {}).pass());
  EXPECT_FALSE(run_entry(kSome[1], {}).pass());  // no rows: nothing was asked
  EXPECT_FALSE(run_entry(kSome[2], {}).pass());
  const Entry broken{
      "fluid.broken", {"here"}, [](const Context&) -> std::vector<Row> { throw std::runtime_error("why"); }};
  const Outcome outcome = run_entry(broken, {});
  EXPECT_EQ(outcome.failure, "why");
  EXPECT_FALSE(outcome.pass());
}

TEST(ValidateOutcome, IsWrittenAsJson) {
  const Entry odd = entry("fluid.odd", {at_most_row("infinite", std::numeric_limits<double>::infinity(), 1)});
  const auto json =
      nlohmann::json::parse(outcomes_json({run_entry(kSome[0], {}), run_entry(odd, {})}, {.quick = true, .plots = {}}));
  EXPECT_TRUE(json.contains("machine") && json.contains("commit"));
  ASSERT_EQ(json["entries"].size(), 2u);
  const auto& first = json["entries"][0];
  EXPECT_EQ(first["name"], "fluid.one");
  EXPECT_EQ(first["pass"], true);
  EXPECT_EQ(first["source"], "here (a.csv, b.csv)");
  EXPECT_EQ(json["quick"], true);
  EXPECT_EQ(json["precision"], "double");
  EXPECT_NE(outcomes_json({}, {.precision = Precision::float32, .plots = {}}).find("\"precision\": \"float\""),
            std::string::npos);
  EXPECT_EQ(first["rows"][0]["value"], 1.0);
  EXPECT_TRUE(json["entries"][1]["rows"][0]["value"].is_null());
  EXPECT_EQ(json["entries"][1]["pass"], false);
}

TEST(ValidateTable, HoldsAnyTextInAFieldOfOneLine) {
  EXPECT_EQ(csv_field("water"), "water");
  for (const std::string text : {"water, oil", "the \"wet\" one", "\"", "a \"b\", c"}) {
    const ReferenceTable table = ReferenceTable::parse("# here\nid,text\n1," + csv_field(text) + "\n", "t.csv");
    EXPECT_EQ(table.where("id", "1").text("text"), text);
  }
  EXPECT_EQ(csv_field("a.toml:1:1: no net\na.toml:2:1: no bed"), "a.toml:1:1: no net; a.toml:2:1: no bed");
}

TEST(ValidateOutcome, IsKnownByItsJson) {
  EXPECT_TRUE(is_outcomes_json(outcomes_json({run_entry(kSome[0], {})}, {})));
  for (const char* other : {"", "[]", "thesis", "{\"entries\": []}", "{\"machine\": 1, \"commit\": 2, \"entries\": 3}",
                            "{\"machine\": 1, \"commit\": 2, \"entries\": [{\"name\": 3}]}"})
    EXPECT_FALSE(is_outcomes_json(other)) << other;
}

/// A pulse of straight lines, sampled every tenth of a ms, then still air.
Samples triangle(double rise, double decay) {
  Samples s;
  for (int k = 0; k < 3000; ++k) {
    const double t = 1e-4 * k, after = t - 0.02;
    s.time.push_back(t);
    s.value.push_back(after < 0 ? 0 : after < rise ? after / rise : std::max(0.0, 1 - (after - rise) / decay));
  }
  return s;
}

TEST(Pulse, HasTheMeansOfATriangle) {
  const Samples s = triangle(0.007, 0.104);
  const Window all = window_from(s, 200, 0.111);
  EXPECT_EQ(all.first, 200u);
  EXPECT_NEAR(s.time[all.last] - s.time[all.first], 0.111, 1.1e-4);
  EXPECT_NEAR(integral(s, all), 0.111 / 2, 1e-4);
  for (const double span : {0.005, 0.02}) {
    const Window best = largest_mean(s, all, span);
    EXPECT_NEAR(mean(s, best), largest_mean_of_triangle(span, 0.007, 0.104), 2e-3) << span;
    EXPECT_NEAR(s.time[best.first], 0.027 - 0.007 * span / 0.111, 2e-4) << span;  // where it is as high as at its end
  }
}

/// A mean over a stretch that ends outside of the window is none of its means.
TEST(Pulse, LooksNoFartherThanItsWindow) {
  Samples s = triangle(0.007, 0.104);
  s.value[2000] = 1000;
  EXPECT_LT(mean(s, largest_mean(s, window_from(s, 200, 0.111), 0.005)), 1);
}

TEST(Pulse, RingsByWhatAMeanTakesAway) {
  Samples calm, rings;
  for (int k = 0; k < 2000; ++k) {
    const double t = 1e-4 * k, wave = std::sin(2 * std::numbers::pi * t / 5.1e-3);  // 5 ms are about a period
    for (Samples* s : {&calm, &rings}) s->time.push_back(t);
    calm.value.push_back(2);
    rings.value.push_back(2 + (t < 0.007 ? 100 * wave : 0.3 * wave));  // what is early does not count
  }
  EXPECT_NEAR(ringing(calm, window_from(calm, 0, 0.111)), 0, 1e-12);
  EXPECT_NEAR(ringing(rings, window_from(rings, 0, 0.111)), 0.3 / std::sqrt(2) / 2, 0.005);
}

/// Beyond 0.6 there is no room to shake a pack, only to push it apart.
TEST(HardSpheres, JamAtTheFractionOfPackedGrains) {
  constexpr std::size_t count = 60;
  constexpr double diameter = 1;
  const double box = std::cbrt(count * std::numbers::pi / 6 / 0.64);
  const std::vector<Vec3> pack = jammed_spheres(count, box, diameter, 1);
  ASSERT_EQ(pack.size(), count);
  double nearest = box;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Vec3 d = pack[i] - pack[j];
      for (int a = 0; a < 3; ++a) d[a] -= box * std::round(d[a] / box);
      nearest = std::min(nearest, d.norm());
    }
  EXPECT_GE(nearest, (1 - kJammedOverlap) * diameter);
  EXPECT_LT(nearest, diameter);  // no room is left
}

/// What is lost may not come back: held against the start alone it might.
TEST(EnergyRise, CountsFromTheLowestSoFar) {
  EnergyRise rise;
  for (const double energy : {1.0, 0.3, 0.5, 0.2, 0.35}) rise.note(energy);
  EXPECT_DOUBLE_EQ(rise.largest(), 0.2);
}

}  // namespace
}  // namespace lahar::validate
