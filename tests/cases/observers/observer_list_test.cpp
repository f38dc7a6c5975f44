#include "cases/observers/observer_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "cases/assembly/measured_names.h"
#include "cases/observers/flow.h"
#include "cases/observers/fluid_cells.h"
#include "tests/cases/observers/sampled.h"

namespace lahar::cases {
namespace {

scene::Scene everything() { return scene::load(scene::source_folder() / "tests/cases/observers/everything.toml"); }

TEST(ObserverList, NamesAreTheirOwnAndEndInTheirUnit) {
  const scene::Scene scene = everything();
  const auto simulation = build_simulation(scene, Beginning::checkpoint);
  const ObserverList observers(scene, *simulation);
  std::set<std::string> columns, metrics;
  for (const Quantity* q : observers.quantities()) {
    EXPECT_TRUE(q->read) << q->label.name;
    EXPECT_TRUE(!q->is_column || columns.insert(q->label.name).second) << q->label.name;
    for (const Metric& m : q->metrics) {
      EXPECT_TRUE(metrics.insert(m.label.name).second) << m.label.name;
      const std::string unit = m.unit == "m^3/s" ? "m3_s" : m.unit == "m^3" ? "m3" : m.unit == "m/s" ? "m_s" : m.unit;
      EXPECT_TRUE(unit == "1" || m.label.name.ends_with("_" + unit)) << m.label.name;
    }
  }
  EXPECT_GT(columns.size(), 40u);
  EXPECT_GT(metrics.size(), 50u);
}

/// Names of all columns and metrics of a scene's run.
std::set<std::string> written_by(const scene::Scene& scene) {
  const auto simulation = build_simulation(scene, Beginning::checkpoint);
  const ObserverList observers(scene, *simulation);
  std::set<std::string> names;
  for (const Quantity* q : observers.quantities()) {
    if (q->is_column) names.insert(q->label.name);
    for (const Metric& m : q->metrics) names.insert(m.label.name);
  }
  return names;
}

/// What the check of a scene takes for names is what a run writes, and all of it: with rings, with a mesh, with posts.
TEST(ObserverList, NamesAreThoseThatTheSceneIsCheckedFor) {
  const scene::Scene scene = everything();
  std::set<std::string> of_program, of_scene, of_any_run;
  for (const std::string& name : scene::own_names()) of_program.insert(name);
  for (const auto& probe : scene.probes)
    for (const std::string& name : scene::names_of(probe)) of_scene.insert(name);
  for (const auto& section : scene.sections)
    for (const std::string& name : scene::names_of(section)) of_scene.insert(name);
  const std::set<std::string> written = written_by(scene);
  for (const std::string& name : of_scene) EXPECT_TRUE(written.contains(name)) << name;
  for (const scene::Scene& one : {scene, scene::load(scene::case_file("hexagonal_net/scene.toml")),
                                  scene::load(scene::case_file("two_spans/scene.toml"))})
    of_any_run.merge(written_by(one));
  for (const std::string& name : of_any_run) EXPECT_TRUE(of_program.contains(name) || of_scene.contains(name)) << name;
  of_any_run.insert({"time_s", "ring_links_changed"});  // of the rows themselves, and of a check
  for (const std::string& name : of_program) EXPECT_TRUE(of_any_run.contains(name)) << name << " is in no run";
}

/// With posts there are foundations in place of the ends of cables.
TEST(ObserverList, TellsOfFoundations) {
  const std::set<std::string> written = written_by(scene::load(scene::case_file("two_spans/scene.toml")));
  for (const char* name :
       {"posts_foot_force_N", "posts_foot_moment_Nm", "retaining_cables_anchor_force_N", "barrier_contact_force_x_N"})
    EXPECT_TRUE(written.contains(name)) << name;
  EXPECT_FALSE(written.contains("upper_cable_end_force_N"));
}

/// The row of a moment, and the metrics that follow from it.
TEST(ObserverList, ARowHoldsWhatIsThere) {
  Sampled run(everything());
  run.take_row();
  run.take_row(1);
  const FluidView& fluid = *run.simulation->fluid();
  ASSERT_EQ(run.rows().time_s.size(), 2u);
  EXPECT_EQ(run.column("liquid_mass_kg")[1], fluid.liquid_mass());
  EXPECT_EQ(run.column("wet_cells")[1], static_cast<double>(fluid.wet_cells()));
  EXPECT_EQ(run.column("fluid_kinetic_J")[1], run.observers.find<Flow>()->now().kinetic);
  EXPECT_GT(run.column("grains_potential_J")[0], 0);
  const Metrics metrics = run.metrics();
  EXPECT_EQ(metrics.at("max_speed_lu"), fluid.max_speed_lu());
  EXPECT_EQ(metrics.at("retained_mass_ratio"), 1);
  EXPECT_FALSE(metrics.contains("front_arrival_s"));
  EXPECT_GE(run.observers.find<FluidCells>()->most_blocks(), fluid.active_blocks());
  EXPECT_EQ(run.observers.last_time(), run.simulation->time());
  for (const ResultCheck& check : run.observers.checks()) EXPECT_TRUE(check.pass) << check.name;
  EXPECT_EQ(run.observers.checks().size(), 4u);
}

/// Columns of the parts of a vector.
using Parts = std::vector<std::string>;

/// A value in a row, or the length of a vector, whose parts may be sums of several columns.
double size_in_row(Sampled& run, const std::vector<Parts>& summands, std::size_t row) {
  double sum = 0, square = 0;
  for (std::size_t part = 0; part < summands.front().size(); ++part) {
    sum = 0;
    for (const Parts& columns : summands) sum += run.column(columns[part])[row];
    square += sum * sum;
  }
  return summands.front().size() == 1 ? sum : std::sqrt(square);
}

Parts along_axes(const std::string& before, const std::string& after) {
  return {before + "x" + after, before + "y" + after, before + "z" + after};
}

/// Gauges in the water of the small debris flow: what is largest among the rows, and when that was first.
TEST(ObserverList, PeaksAreTheLargestRowsAndTheirTimes) {
  Sampled run(scene::load(scene::source_folder() / "tests/cases/observers/everything.toml",
                          {"probe[0].position_m=[0.28, 0.1, 0]", "probe[1].position_m=[0.2, 0.1, 0.01]",
                           "probe[2].position_m=[0.2, 0.1, 0.05]", "section[0].point_m=[0.2, 0.13, 0.2]"}));
  run.take_rows_until(0.06, 0.005);
  struct Peak {
    const char *peak, *time;
    std::vector<Parts> of;
  };
  const Peak peaks[] = {{"depth_peak_m", "depth_peak_time_s", {{"depth"}}},
                        {"pressure_peak_Pa", "pressure_peak_time_s", {{"pressure"}}},
                        {"current_speed_peak_m_s", "current_speed_peak_time_s", {along_axes("current_", "_m_s")}},
                        {"stone_speed_peak_m_s", "stone_speed_peak_time_s", {along_axes("stone_", "_m_s")}},
                        {"load_force_peak_N",
                         "load_force_peak_time_s",
                         {along_axes("load_fluid_force_", "_N"), along_axes("load_grains_force_", "_N")}},
                        {"load_moment_peak_Nm",
                         "load_moment_peak_time_s",
                         {along_axes("load_fluid_moment_", "_Nm"), along_axes("load_grains_moment_", "_Nm")}},
                        {"gate_discharge_peak_m3_s", "gate_discharge_peak_time_s", {{"gate_discharge_m3_s"}}}};
  const Metrics metrics = run.metrics();
  for (const Peak& expected : peaks) {
    double largest = 0, when = 0;
    for (std::size_t row = 0; row < run.rows().time_s.size(); ++row)
      if (const double now = size_in_row(run, expected.of, row); now > largest)
        largest = now, when = run.rows().time_s[row];
    EXPECT_GT(largest, 0) << expected.peak;
    EXPECT_NEAR(metrics.at(expected.peak), largest, 1e-12 * largest) << expected.peak;
    EXPECT_EQ(metrics.at(expected.time), when) << expected.time;
  }
}

/// All that a run reads, row by row, as bits: some are not known.
std::vector<std::uint64_t> readings(const scene::Scene& scene, bool renumbers) {
  Sampled run(scene);
  std::vector<std::uint64_t> all;
  std::mt19937 random(3);
  for (int row = 0; row < 6; ++row) {
    for (int n = 0; n < 20; ++n) run.step();
    std::vector<dem::ParticleIndex> order(run.solids().particles().size());
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), random);
    if (renumbers) run.solids().renumber(dem::Renumbering(std::move(order)));
    run.take_row();
    for (const Quantity* q : run.observers.quantities()) all.push_back(std::bit_cast<std::uint64_t>(q->read()));
  }
  for (const auto& [name, value] : run.metrics()) all.push_back(std::bit_cast<std::uint64_t>(value));
  return all;
}

TEST(ObserverList, RenumberedParticlesReadTheSame) {
  const scene::Scene scene = everything();
  EXPECT_EQ(readings(scene, false), readings(scene, true));
}

/// A scene has the quantities of its parts alone.
TEST(ObserverList, OnlyWhatTheSceneHas) {
  const scene::Scene scene = scene::load_text(scene::small_scene);
  const auto simulation = build_simulation(scene);
  const ObserverList observers(scene, *simulation);
  EXPECT_EQ(observers.find<Flow>(), nullptr);
  std::set<std::string> names;
  for (const Quantity* q : observers.quantities()) names.insert(q->label.name);
  EXPECT_TRUE(names.contains("grains_kinetic_J"));
  EXPECT_FALSE(names.contains("liquid_mass_kg"));
  EXPECT_TRUE(observers.checks().empty());
}

}  // namespace
}  // namespace lahar::cases
