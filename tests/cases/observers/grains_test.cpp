// Grains before and behind a section: their energy, what has passed.
#include "cases/observers/grains.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/cases/observers/sampled.h"
#include "tests/cases/observers/two_balls.h"

namespace lahar::cases {
namespace {

/// kg, of a ball of rock.
double mass(double diameter) { return 2500 * M_PI / 6 * diameter * diameter * diameter; }

TEST(Grains, EnergyPassageAndRetention) {
  Sampled run(scene::load_text(two_balls));
  run.take_row();
  const double large = mass(0.1), small = mass(0.05), g = 9.81;
  const Grains& grains = *run.observers.find<Grains>();
  EXPECT_NEAR(grains.energy(), 0.5 * large * 4 + large * g * 0.5 + small * g * 0.2, 1e-9);
  EXPECT_EQ(grains.energy_out(), 0);  // the small one was beyond from the start
  const Metrics metrics = run.metrics();
  EXPECT_EQ(metrics.at("particle_arrival_s"), 0);
  EXPECT_NEAR(metrics.at("retained_mass_ratio"), large / (large + small), 1e-12);
  EXPECT_EQ(metrics.at("retained_small_grains_ratio"), 0);
  EXPECT_EQ(metrics.at("retained_large_grains_ratio"), 1);
  // What passes takes its energy with it, once; what is gone has passed for good.
  run.solids().particles().position.x[0] = 0.75;
  run.take_row();
  run.solids().remove(0);
  run.solids().remove(1);
  run.take_row();
  EXPECT_EQ(grains.energy(), 0);
  EXPECT_NEAR(grains.energy_out(), 0.5 * large * 4 + large * g * 0.5, 1e-9);
  EXPECT_EQ(run.metrics().at("retained_mass_ratio"), 0);
}

TEST(Grains, WhatIsBeyondAtTheStartHasNotPassed) {
  Sampled run(scene::load_text(two_balls));
  run.take_row();
  run.solids().remove(1);  // as it leaves the domain
  run.take_row();
  run.solids().particles().position.x[0] = 0.75;
  run.take_row();
  const std::vector<double>& passed = run.column("grains_passed_kg");
  EXPECT_EQ(passed[0], 0);
  EXPECT_EQ(passed[1], 0);
  EXPECT_NEAR(passed[2], mass(0.1), 1e-9);
}

/// A ball that leaves the domain between two rows, through the open end or a side, is taken out of the scene there and
/// stands still from then on: it has taken along what it had.
TEST(Grains, WhatLeavesBetweenRowsHasPassedWithItsSpeed) {
  for (const Vec3& place : {Vec3(1.06, 0.5, 0.5), Vec3(0.3, -0.06, 0.5), Vec3(0.3, 0.5, -0.06)}) {
    Sampled run(scene::load_text(two_balls));
    run.take_row();
    dem::Particles& p = run.solids().particles();
    p.position.set(0, place);
    ASSERT_TRUE(has_left(run.scene.domain, p, 0));
    run.observers.after_step();
    run.solids().remove(0);
    run.take_row();
    const double kinetic = 0.5 * mass(0.1) * 4;
    EXPECT_NEAR(run.observers.find<Grains>()->energy_out(), kinetic + mass(0.1) * 9.81 * place.z(), 1e-9);
    EXPECT_NEAR(1000 * run.metrics().at("e_out_grains_kinetic_kJ"), kinetic, 1e-9);
  }
}

TEST(Grains, WhatFliesUpHasNotLeft) {
  Sampled run(scene::load_text(two_balls));
  dem::Particles& p = run.solids().particles();
  p.position.set(0, Vec3(0.3, 0.5, 7));
  EXPECT_FALSE(has_left(run.scene.domain, p, 0));
}

/// The small ball as an obstacle behind the section: no quantity of the grains tells of it.
TEST(Grains, FixedOnesAreObstacles) {
  Sampled run(scene::load_text(two_balls, {"grains.sphere[1].fixed=true"}));
  run.take_row();
  EXPECT_NEAR(run.observers.find<Grains>()->energy(), 0.5 * mass(0.1) * 4 + mass(0.1) * 9.81 * 0.5, 1e-9);
  EXPECT_EQ(run.observers.find<Grains>()->energy_out(), 0);
  EXPECT_EQ(run.column("grains_passed_kg").back(), 0);
  EXPECT_NEAR(run.column("grains_front_x_m").back(), 0.55, 1e-12);
  const Metrics metrics = run.metrics();
  EXPECT_FALSE(metrics.contains("particle_arrival_s"));
  EXPECT_EQ(metrics.at("retained_mass_ratio"), 1);
  EXPECT_FALSE(metrics.contains("retained_small_grains_ratio"));
}

/// Also where nothing is measured: what is gone has passed.
TEST(Grains, WhatIsGoneHasPassed) {
  scene::Scene scene = scene::load_text(two_balls);
  scene.measure.section_x.reset();
  Sampled run(scene);
  run.take_row();
  run.solids().remove(0);
  run.take_row();
  EXPECT_NEAR(run.column("grains_passed_kg").back(), mass(0.1), 1e-9);
}

}  // namespace
}  // namespace lahar::cases
