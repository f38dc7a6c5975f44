// The ladder's own machinery, and the quick form of entries that take seconds.
#include "cases/validate/entry.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cases/validate/outcome_table.h"

namespace lahar::validate {
namespace {

Entry entry(const std::string& name, std::vector<Row> rows) {
  return {name, "here", [rows](const Context&) { return rows; }};
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

TEST(ValidateOutcome, NeedsRowsThatAllPassAndNoFailure) {
  EXPECT_TRUE(run_entry(kSome[0], {}).pass());
  EXPECT_FALSE(run_entry(kSome[1], {}).pass());  // no rows: nothing was asked
  EXPECT_FALSE(run_entry(kSome[2], {}).pass());
  const Entry broken{"fluid.broken", "here",
                     [](const Context&) -> std::vector<Row> { throw std::runtime_error("why"); }};
  const Outcome outcome = run_entry(broken, {});
  EXPECT_EQ(outcome.failure, "why");
  EXPECT_FALSE(outcome.pass());
}

TEST(ValidateOutcome, IsWrittenAsTables) {
  const Entry misses = entry("fluid.misses", {at_most_row("a|b", 2, 1), at_most_row("c", 0.5, 1)});
  const std::string text = outcomes_markdown({run_entry(kSome[0], {}), run_entry(misses, {})}, {});
  EXPECT_NE(text.find("1 of 2 entries reach their bars"), std::string::npos) << text;
  EXPECT_NE(text.find("| a\\|b | 2 | 0 | 2 | 1 | **short** |\n"), std::string::npos) << text;
  EXPECT_NE(text.find("| c | 0.5 | 0 | 0.5 | 1 |  |\n"), std::string::npos) << text;
}

TEST(ValidateOutcome, IsWrittenAsJson) {
  const Entry odd = entry("fluid.odd", {at_most_row("infinite", std::numeric_limits<double>::infinity(), 1)});
  const auto json = nlohmann::json::parse(outcomes_json({run_entry(kSome[0], {}), run_entry(odd, {})}));
  EXPECT_TRUE(json.contains("machine") && json.contains("commit"));
  ASSERT_EQ(json["entries"].size(), 2u);
  const auto& first = json["entries"][0];
  EXPECT_EQ(first["name"], "fluid.one");
  EXPECT_EQ(first["pass"], true);
  EXPECT_EQ(first["source"], "here");
  EXPECT_EQ(first["rows"][0]["value"], 1.0);
  EXPECT_TRUE(json["entries"][1]["rows"][0]["value"].is_null());
  EXPECT_EQ(json["entries"][1]["pass"], false);
}

class QuickEntry : public testing::TestWithParam<const char*> {};

TEST_P(QuickEntry, ReachesItsBars) {
  const auto chosen = select_entries(all_entries(), {GetParam()});
  ASSERT_EQ(chosen.size(), 1u);
  const Outcome outcome = run_entry(chosen[0], {.quick = true, .plots = {}});
  EXPECT_TRUE(outcome.pass()) << outcome_text(outcome);
}

INSTANTIATE_TEST_SUITE_P(Fluid, QuickEntry,
                         testing::Values("fluid.order_taylor_green", "fluid.order_poiseuille", "fluid.order_duct",
                                         "fluid.order_couette", "fluid.taylor_green_re1600", "fluid.cavity_re1000",
                                         "fluid.determinism", "fluid.hard_h12", "fluid.hard_h19", "fluid.shear_layer",
                                         "fluid.slipping_box", "fluid.adaptive_time_step", "fluid.laplace_drop"),
                         [](const auto& param) { return std::string(param.param).substr(6); });

INSTANTIATE_TEST_SUITE_P(SolidsContact, QuickEntry,
                         testing::Values("solids.chung_ooi_1", "solids.chung_ooi_2", "solids.chung_ooi_3",
                                         "solids.incline_35", "solids.rolling_incline", "solids.restitution",
                                         "solids.hard_h15", "solids.hard_h16", "solids.hard_h9", "solids.cantilever",
                                         "solids.catenary", "solids.column_collapse", "solids.energy_ledger",
                                         "solids.post", "solids.two_spans", "solids.hexagonal_mesh",
                                         "solids.wire_sliding"),
                         [](const auto& param) { return std::string(param.param).substr(7); });

INSTANTIATE_TEST_SUITE_P(Bodies, QuickEntry,
                         testing::Values("bodies.wire", "bodies.resolved_wire", "bodies.random_pack", "bodies.screen",
                                         "bodies.ring_net_drag", "bodies.archimedes", "bodies.hard_h6_ring",
                                         "bodies.hard_h7", "bodies.hard_h8_sphere", "bodies.hard_h8_cavity",
                                         "bodies.hard_h10", "bodies.hard_h17", "bodies.momentum_audit"),
                         [](const auto& param) { return std::string(param.param).substr(7); });

}  // namespace
}  // namespace lahar::validate
