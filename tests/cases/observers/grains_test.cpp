// Grains before and behind a section: their energy, what has passed.
#include "cases/observers/grains.h"

#include <gtest/gtest.h>

#include "cases/files/series_reader.h"
#include "cases/observers/observer_list.h"
#include "tests/cases/observers/two_balls.h"

namespace lahar::cases {
namespace {

TEST(Grains, EnergyPassageAndRetention) {
  const scene::Scene scene = scene::load_text(two_balls);
  const auto simulation = build_simulation(scene);
  ObserverList observers(scene, *simulation);
  const scene::ScratchFolder scratch;
  SeriesWriter series(scratch.path() / "series.h5");
  observers.declare(series);
  observers.sample(series);
  const auto mass = [](double d) { return 2500 * M_PI / 6 * d * d * d; };
  const double large = mass(0.1), small = mass(0.05), g = 9.81;
  const Grains& grains = *observers.find<Grains>();
  EXPECT_NEAR(grains.energy(), 0.5 * large * 4 + large * g * 0.5 + small * g * 0.2, 1e-9);
  EXPECT_EQ(grains.energy_out(), 0);  // the small one was beyond from the start
  const Metrics metrics = observers.metrics();
  EXPECT_EQ(metrics.at("particle_arrival_s"), 0);
  EXPECT_NEAR(metrics.at("retained_mass_ratio"), large / (large + small), 1e-12);
  EXPECT_EQ(metrics.at("retained_small_grains_ratio"), 0);
  EXPECT_EQ(metrics.at("retained_large_grains_ratio"), 1);
  // What passes takes its energy with it, once; what is gone has passed for good.
  simulation->solids()->particles().position.x[0] = 0.75;
  observers.sample(series);
  simulation->solids()->remove(0);
  simulation->solids()->remove(1);
  observers.sample(series);
  EXPECT_EQ(grains.energy(), 0);
  EXPECT_NEAR(grains.energy_out(), 0.5 * large * 4 + large * g * 0.5, 1e-9);
  EXPECT_EQ(observers.metrics().at("retained_mass_ratio"), 0);
}

/// Mass that has passed, kg, row by row.
std::vector<double> passed(const scene::ScratchFolder& scratch) {
  return read_series(scratch.path() / "series.h5").find("grains_passed_kg")->values;
}

TEST(Grains, WhatIsBeyondAtTheStartHasNotPassed) {
  const scene::Scene scene = scene::load_text(two_balls);
  const auto simulation = build_simulation(scene);
  ObserverList observers(scene, *simulation);
  const scene::ScratchFolder scratch;
  {
    SeriesWriter series(scratch.path() / "series.h5");
    observers.declare(series);
    observers.sample(series);
    simulation->solids()->remove(1);  // as it leaves the domain
    observers.sample(series);
    simulation->solids()->particles().position.x[0] = 0.75;
    observers.sample(series);
    series.close();
  }
  const std::vector<double> rows = passed(scratch);
  EXPECT_EQ(rows[0], 0);
  EXPECT_EQ(rows[1], 0);
  EXPECT_NEAR(rows[2], 2500 * M_PI / 6 * 0.1 * 0.1 * 0.1, 1e-9);
}

/// The small ball as an obstacle behind the section: no quantity of the grains tells of it.
TEST(Grains, FixedOnesAreObstacles) {
  const scene::Scene scene = scene::load_text(two_balls, {"grains.sphere[1].fixed=true"});
  const auto simulation = build_simulation(scene);
  ObserverList observers(scene, *simulation);
  const scene::ScratchFolder scratch;
  {
    SeriesWriter series(scratch.path() / "series.h5");
    observers.declare(series);
    observers.sample(series);
    series.close();
  }
  const double large = 2500 * M_PI / 6 * 0.1 * 0.1 * 0.1;
  EXPECT_NEAR(observers.find<Grains>()->energy(), 0.5 * large * 4 + large * 9.81 * 0.5, 1e-9);
  EXPECT_EQ(observers.find<Grains>()->energy_out(), 0);
  EXPECT_EQ(passed(scratch).back(), 0);
  EXPECT_NEAR(read_series(scratch.path() / "series.h5").find("grains_front_x_m")->values.back(), 0.55, 1e-12);
  const Metrics metrics = observers.metrics();
  EXPECT_FALSE(metrics.contains("particle_arrival_s"));
  EXPECT_EQ(metrics.at("retained_mass_ratio"), 1);
  EXPECT_FALSE(metrics.contains("retained_small_grains_ratio"));
}

/// Also where nothing is measured: what is gone has passed.
TEST(Grains, WhatIsGoneHasPassed) {
  scene::Scene scene = scene::load_text(two_balls);
  scene.measure.section_x.reset();
  const auto simulation = build_simulation(scene);
  ObserverList observers(scene, *simulation);
  const scene::ScratchFolder scratch;
  {
    SeriesWriter series(scratch.path() / "series.h5");
    observers.declare(series);
    observers.sample(series);
    simulation->solids()->remove(0);
    observers.sample(series);
    series.close();
  }
  const double mass = 2500 * M_PI / 6 * 0.1 * 0.1 * 0.1;
  EXPECT_NEAR(passed(scratch).back(), mass, 1e-9);
}

}  // namespace
}  // namespace lahar::cases
