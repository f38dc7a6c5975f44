#include "cases/observers/quantity_tables.h"

#include <gtest/gtest.h>

#include "cases/observers/observer_list.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

scene::Scene everything() { return scene::load(scene::source_folder() / "tests/cases/observers/everything.toml"); }

TEST(QuantityTables, PatternsStandOnce) {
  const scene::Scene scene = everything();
  const auto simulation = build_simulation(scene, Beginning::checkpoint);
  const std::string text = quantity_tables(ObserverList(scene, *simulation).quantities(), Naming::patterns);
  const auto count = [&](const std::string& word) {
    std::size_t n = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("| `PART_force_sum_N` |"), 1u);
  EXPECT_EQ(count("| `PROBE_fluid_force_AXIS_N` |"), 1u);
  EXPECT_EQ(count("| `PROBE` |"), 2u);  // depth and pressure
  EXPECT_EQ(count("lower_cable"), 0u);
}

/// The tables of docs/outputs.md are those that the observers make.
TEST(QuantityTables, DocsAreCurrent) {
  const scene::Scene scene = everything();
  const auto simulation = build_simulation(scene, Beginning::checkpoint);
  const std::string text = quantity_tables(ObserverList(scene, *simulation).quantities(), Naming::patterns);
  const std::string docs = scene::file_text(scene::source_folder() / "docs/outputs.md");
  const std::string begin = "<!-- made by tools/write_quantities -->\n", end = "<!-- end -->\n";
  const auto from = docs.find(begin), to = docs.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(docs.substr(from + begin.size(), to - from - begin.size()), text)
      << "write it anew: tools/write_quantities";
}

}  // namespace
}  // namespace lahar::cases
