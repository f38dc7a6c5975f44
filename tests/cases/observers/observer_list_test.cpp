#include "cases/observers/observer_list.h"

#include <gtest/gtest.h>

#include <bit>
#include <numeric>
#include <random>
#include <set>

#include "cases/assembly/measured_names.h"
#include "cases/files/series_reader.h"
#include "cases/observers/flow.h"
#include "cases/observers/fluid_cells.h"
#include "tests/cases/scene/scene_files.h"

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

/// What the check of a scene takes for names is what a run writes.
TEST(ObserverList, NamesAreThoseThatTheSceneIsCheckedFor) {
  const scene::Scene scene = everything();
  const auto simulation = build_simulation(scene, Beginning::checkpoint);
  const ObserverList observers(scene, *simulation);
  std::set<std::string> of_program, of_scene, written;
  for (const std::string& name : scene::own_names()) of_program.insert(name);
  for (const auto& probe : scene.probes)
    for (const std::string& name : scene::names_of(probe)) of_scene.insert(name);
  for (const auto& section : scene.sections)
    for (const std::string& name : scene::names_of(section)) of_scene.insert(name);
  for (const Quantity* q : observers.quantities()) {
    if (q->is_column) written.insert(q->label.name);
    for (const Metric& m : q->metrics) written.insert(m.label.name);
  }
  for (const std::string& name : written) EXPECT_TRUE(of_program.contains(name) || of_scene.contains(name)) << name;
  for (const std::string& name : of_scene) EXPECT_TRUE(written.contains(name)) << name;
}

/// With posts there are foundations in place of the ends of cables, whose names are the program's too.
TEST(ObserverList, TellsOfFoundations) {
  const scene::Scene scene = scene::load(scene::case_file("two_spans/scene.toml"));
  const auto simulation = build_simulation(scene, Beginning::checkpoint);
  const ObserverList observers(scene, *simulation);
  const std::vector<std::string> own = scene::own_names();
  std::set<std::string> of_program(own.begin(), own.end()), written;
  for (const Quantity* q : observers.quantities()) written.insert(q->label.name);
  for (const char* name : {"posts_foot_force_N", "posts_foot_moment_Nm", "retaining_cables_anchor_force_N"})
    EXPECT_TRUE(written.contains(name) && of_program.contains(name)) << name;
  EXPECT_TRUE(written.contains("barrier_contact_force_x_N"));
  EXPECT_FALSE(written.contains("upper_cable_end_force_N"));
}

/// The row of a moment, and the metrics that follow from it.
TEST(ObserverList, ARowHoldsWhatIsThere) {
  const scene::Scene scene = everything();
  const auto simulation = build_simulation(scene);
  ObserverList observers(scene, *simulation);
  const scene::ScratchFolder scratch;
  {
    SeriesWriter series(scratch.path() / "series.h5");
    observers.declare(series);
    observers.sample(series);
    simulation->advance();
    observers.after_step();
    observers.sample(series);
  }
  const Series series = read_series(scratch.path() / "series.h5");
  ASSERT_EQ(series.time_s.size(), 2u);
  EXPECT_EQ(series.find("liquid_mass_kg")->values[1], simulation->fluid()->liquid_mass());
  EXPECT_EQ(series.find("wet_cells")->values[1], static_cast<double>(simulation->fluid()->wet_cells()));
  EXPECT_EQ(series.find("fluid_kinetic_J")->values[1], observers.find<Flow>()->now().kinetic);
  EXPECT_GT(series.find("grains_potential_J")->values[0], 0);
  const Metrics metrics = observers.metrics();
  EXPECT_EQ(metrics.at("max_speed_lu"), simulation->fluid()->max_speed_lu());
  EXPECT_EQ(metrics.at("retained_mass_ratio"), 1);
  EXPECT_FALSE(metrics.contains("front_arrival_s"));
  EXPECT_GE(observers.find<FluidCells>()->most_blocks(), simulation->fluid()->active_blocks());
  EXPECT_EQ(observers.last_time(), simulation->time());
  for (const ResultCheck& check : observers.checks()) EXPECT_TRUE(check.pass) << check.name;
  EXPECT_EQ(observers.checks().size(), 3u);
}

/// All that a run reads, row by row, as bits: some are not known.
std::vector<std::uint64_t> readings(const scene::Scene& scene, bool renumbers) {
  const auto simulation = build_simulation(scene);
  ObserverList observers(scene, *simulation);
  const scene::ScratchFolder scratch;
  SeriesWriter series(scratch.path() / "series.h5");
  observers.declare(series);
  std::vector<std::uint64_t> all;
  std::mt19937 random(3);
  for (int n = 0; n < 120; ++n) {
    simulation->advance();
    observers.after_step();
    if (n % 20 != 19) continue;
    std::vector<dem::ParticleIndex> order(simulation->solids()->particles().size());
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), random);
    if (renumbers) simulation->solids()->renumber(dem::Renumbering(std::move(order)));
    observers.sample(series);
    for (const Quantity* q : observers.quantities()) all.push_back(std::bit_cast<std::uint64_t>(q->read()));
  }
  for (const auto& [name, value] : observers.metrics()) all.push_back(std::bit_cast<std::uint64_t>(value));
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
