// Grains before and behind a section: their energy, what has passed, what is held.
#include "cases/observers/grains.h"

#include <gtest/gtest.h>

#include "cases/observers/observer_list.h"
#include "cases/observers/retention.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

const std::string two_balls = scene::small_scene + R"(velocity_m_s = [2, 0, 0]
[[grains.sphere]]
position_m = [0.8, 0.5, 0.2]
diameter_m = 0.05
density_kg_m3 = 2500
material = "rock"
[measure]
section_x_m = 0.6
inflow_distance_m = 0.1
outflow_distance_m = 0.1
)";

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

TEST(Retention, EqualGrainsAreNotToldApart) {
  const scene::Scene scene = scene::load_text(two_balls, {"grains.sphere[1].diameter_m=0.1"});
  const auto simulation = build_simulation(scene);
  const Metrics metrics = ObserverList(scene, *simulation).metrics();
  EXPECT_EQ(metrics.at("retained_mass_ratio"), 0.5);
  EXPECT_FALSE(metrics.contains("retained_small_grains_ratio"));
}

}  // namespace
}  // namespace lahar::cases
