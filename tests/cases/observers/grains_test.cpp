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
  EXPECT_NEAR(grains.energy_out(), small * g * 0.2, 1e-9);
  const Metrics metrics = observers.metrics();
  EXPECT_EQ(metrics.at("particle_arrival_s"), 0);
  EXPECT_NEAR(metrics.at("retained_mass_ratio"), large / (large + small), 1e-12);
  EXPECT_EQ(metrics.at("retained_small_grains_ratio"), 0);
  EXPECT_EQ(metrics.at("retained_large_grains_ratio"), 1);
  // What passes takes its energy with it, once; what is gone has passed for good.
  simulation->solids()->particles().position.x[0] = 0.75;
  observers.sample(series);
  simulation->solids()->remove(0);
  observers.sample(series);
  EXPECT_NEAR(grains.energy(), small * g * 0.2, 1e-9);
  EXPECT_NEAR(grains.energy_out(), small * g * 0.2 + 0.5 * large * 4 + large * g * 0.5, 1e-9);
  EXPECT_EQ(observers.metrics().at("retained_mass_ratio"), 0);
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
    simulation->solids()->remove(0);
    observers.sample(series);
    series.close();
  }
  const double mass = 2500 * M_PI / 6 * 0.1 * 0.1 * 0.1;
  EXPECT_NEAR(read_series(scratch.path() / "series.h5").find("grains_passed_kg")->values.back(), mass, 1e-9);
}

}  // namespace
}  // namespace lahar::cases
