#include "cases/observers/probes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/assembly/build.h"
#include "cases/files/series_reader.h"
#include "cases/runner/run.h"
#include "core/memory_archive.h"
#include "tests/cases/observers/tank_with_ball.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

/// A ball of stone comes to rest on a box: the box carries its weight, and the moment about a corner.
TEST(Probes, GrainsLoadAWall) {
  const std::string text = R"([scene]
name = "resting"
[run]
duration_s = 2.0
series_interval_s = 0.5
[domain]
lower_m = [0, 0, 0]
upper_m = [1, 1, 1]
[[wall]]
name = "table"
shape = "box"
lower_m = [0.2, 0.2, 0]
upper_m = [0.8, 0.8, 0.3]
material = "rock"
[[wall]]
name = "idle"
shape = "box"
lower_m = [0.9, 0.2, 0]
upper_m = [1.0, 0.8, 0.3]
material = "rock"
[materials.rock]
youngs_modulus_Pa = 1e7
poisson_ratio = 0.3
[[contact]]
materials = ["rock", "rock"]
friction = 0.5
restitution = 0.1
[[grains.sphere]]
position_m = [0.5, 0.4, 0.35]
diameter_m = 0.1
density_kg_m3 = 2500
material = "rock"
[[probe]]
name = "load"
kind = "force"
wall = "table"
position_m = [0.2, 0.2, 0]
[[probe]]
name = "none"
kind = "force"
wall = "idle"
position_m = [0, 0, 0]
[[probe]]
name = "beside"
kind = "force"
wall = "table"
position_m = [0.5, 0.4, 0]
)";
  const scene::ScratchFolder scratch;
  const RunResult result =
      run_to_folder(scene::load_text(text), {.out = scratch.path() / "out", .threads = 1, .quiet = true}, run_scene);
  const Series series = read_series(scratch.path() / "out/series.h5");
  const double weight = 2500 * M_PI / 6 * 0.1 * 0.1 * 0.1 * 9.81;
  const auto last = [&](const char* name) { return series.find(name)->values.back(); };
  EXPECT_NEAR(last("load_grains_force_z_N"), -weight, 1e-3 * weight);
  EXPECT_NEAR(last("load_grains_moment_x_Nm"), -0.2 * weight, 1e-3 * weight);
  EXPECT_NEAR(last("load_grains_moment_y_Nm"), 0.3 * weight, 1e-3 * weight);
  EXPECT_EQ(result.summary.metrics.at("none_force_peak_N"), 0);
  EXPECT_EQ(last("beside_grains_force_z_N"), last("load_grains_force_z_N"));
  EXPECT_NEAR(last("beside_grains_moment_y_Nm"), 0, 1e-3 * weight);
}

/// Row by row the mean force is that of the interval: together they are the whole impulse, here that of water at rest.
TEST(Probes, FluidLoadsAWall) {
  const std::string text = tank_with_ball + R"([[probe]]
name = "lift"
kind = "force"
wall = "ball"
position_m = [0.16, 0.08, 0.1]
)";
  const scene::ScratchFolder scratch;
  run_to_folder(scene::load_text(text), {.out = scratch.path() / "out", .threads = 1, .quiet = true}, run_scene);
  const Series series = read_series(scratch.path() / "out/series.h5");
  const auto& z = series.find("lift_fluid_force_z_N")->values;
  double mean = 0;
  for (std::size_t k = 1; k < z.size(); ++k) mean += z[k] / static_cast<double>(z.size() - 1);
  int cells = 0;  // of the staircase that stands for the sphere: what displaces water
  for (int k = 0; k < 1000; ++k)
    cells += Vec3(0.01 * (k % 10) - 0.045, 0.01 * (k / 10 % 10) - 0.045, 0.01 * (k / 100) - 0.045).norm() < 0.05;
  const double lift = 1000 * 9.81 * cells * 1e-6;
  EXPECT_NEAR(lift, 1000 * 9.81 * 4 * M_PI / 3 * 0.05 * 0.05 * 0.05, 0.1 * lift);
  EXPECT_NEAR(mean, lift, 0.02 * lift);
  EXPECT_NEAR(series.find("lift_fluid_moment_y_Nm")->values.back(), 0, 0.01 * lift * 0.05);
}

/// The force of the water on the bed of its tank, whose sides bear nothing of it.
const std::string kLoadOfBed = R"([[wall]]
name = "bed"
shape = "plane"
point_m = [0, 0, 0]
normal = [0, 0, 1]
[[probe]]
name = "load"
kind = "force"
wall = "bed"
position_m = [0, 0, 0]
)";

/// What walls get in a step is booked one step earlier: where the step has just grown, for more than the time that has
/// passed. Water at rest bears with its weight at each step all the same, and with up to 0.26 % more by compression.
TEST(Probes, FluidLoadsAWallWhileTheStepChanges) {
  const scene::ScratchFolder scratch;
  const RunResult run = run_to_folder(
      scene::load_text(tank_of_water + kLoadOfBed, {"run.duration_s=0.1", "run.series_interval_s=1e-6",
                                                    "fluid.adaptive_time_step=true", "fluid.max_speed_m_s=10"}),
      {.out = scratch.path() / "out", .threads = 1, .quiet = true}, run_scene);
  EXPECT_GE(run.summary.metrics.at("fluid_time_step_changes"), 3);
  const Series every = read_series(scratch.path() / "out" / "series.h5");
  const double weight = 1000 * 9.81 * 0.32 * 0.16 * 0.3;
  const auto& force = every.find("load_fluid_force_z_N")->values;
  for (std::size_t k = 1; k < force.size(); ++k) EXPECT_NEAR(force[k], -weight, 0.005 * weight) << every.time_s[k];
  EXPECT_NEAR(run.summary.metrics.at("load_force_peak_N"), weight, 0.005 * weight);
}

/// A checkpoint between two rows holds what has been booked, and for how long.
TEST(Probes, MeanForcesGoOnFromACheckpoint) {
  const scene::Scene s = scene::load_text(tank_of_water + kLoadOfBed);
  const auto whole = build_simulation(s), resumed = build_simulation(s, Beginning::checkpoint);
  const Observed of_whole(s, *whole), of_resumed(s, *resumed);
  Probes one(of_whole), two(of_resumed);
  const auto advance = [](Simulation& run, Probes& probes) {
    for (int n = 0; n < 5; ++n) run.advance(), probes.after_step();
  };
  const auto force = [](const Probes& probes) {
    for (const Quantity& q : probes.quantities())
      if (q.label.name == "load_fluid_force_z_N") return q.read();
    return kUnknown;
  };
  advance(*whole, one);
  StoredState state = state_of(*whole), seen = state_of(one);
  load_state(state, *resumed), load_state(seen, two);
  advance(*whole, one), advance(*resumed, two);
  one.sample(whole->time()), two.sample(resumed->time());
  EXPECT_LT(force(one), 0);
  EXPECT_EQ(force(one), force(two));
}

/// The pressure of a moment and the mean over time, at one point.
const std::string kMomentAndMean = R"([[probe]]
name = "moment"
kind = "pressure"
position_m = [0.0, 0.08, 0.05]
[[probe]]
name = "mean"
kind = "pressure"
position_m = [0.0, 0.08, 0.05]
time_mean = true
)";

/// A mean over the rows' intervals: the pressure at each step, summed, is that of all rows. Where a row comes at every
/// step, mean and moment are the same.
TEST(Probes, PressureAveragedOverTime) {
  const scene::ScratchFolder scratch;
  const auto rows = [&](const char* folder, const std::vector<std::string>& set) {
    run_to_folder(scene::load_text(tank_with_ball + kMomentAndMean, set),
                  {.out = scratch.path() / folder, .threads = 1, .quiet = true}, run_scene);
    return read_series(scratch.path() / folder / "series.h5");
  };
  const Series every = rows("every", {"run.duration_s=0.1", "run.series_interval_s=1e-6"});
  const auto& p = every.find("moment")->values;
  const auto& same = every.find("mean")->values;
  ASSERT_GT(p.size(), 100u);
  for (std::size_t k = 1; k < p.size(); ++k) EXPECT_NEAR(same[k], p[k], 1e-9 * 3000);
  const Series few = rows("few", {"run.duration_s=0.1", "run.series_interval_s=0.02"});
  const auto& mean = few.find("mean")->values;
  double sum = 0, whole = 0;
  for (std::size_t k = 1; k < mean.size(); ++k) sum += mean[k] * (few.time_s[k] - few.time_s[k - 1]);
  for (std::size_t k = 1; k < p.size(); ++k)
    if (every.time_s[k] <= few.time_s.back() + 1e-9) whole += p[k] * (every.time_s[k] - every.time_s[k - 1]);
  EXPECT_NEAR(sum / whole, 1, 1e-6);
  EXPECT_NE(mean[1], few.find("moment")->values[1]);
}

/// Where the fluid's step changes each pressure counts for the time that has passed.
TEST(Probes, PressureAveragedOverTimeWhileTheStepChanges) {
  const scene::ScratchFolder scratch;
  const RunResult run = run_to_folder(
      scene::load_text(tank_with_ball + kMomentAndMean, {"run.duration_s=0.1", "run.series_interval_s=1e-6",
                                                         "fluid.adaptive_time_step=true", "fluid.max_speed_m_s=10"}),
      {.out = scratch.path() / "out", .threads = 1, .quiet = true}, run_scene);
  EXPECT_GE(run.summary.metrics.at("fluid_time_step_changes"), 1);
  const Series every = read_series(scratch.path() / "out" / "series.h5");
  const auto &p = every.find("moment")->values, &same = every.find("mean")->values;
  for (std::size_t k = 1; k < p.size(); ++k) EXPECT_NEAR(same[k], p[k], 1e-9 * 3000) << every.time_s[k];
}

/// What is inside a resolved grain is no liquid: the grain's velocity is none of the liquid's.
TEST(Probes, VelocitiesAreOfTheLiquidAlone) {
  const std::string text = tank_of_water + R"([coupling]
enabled = true
[materials.rock]
youngs_modulus_Pa = 1e7
poisson_ratio = 0.3
[[grains.sphere]]
position_m = [0.16, 0.08, 0.12]
diameter_m = 0.08
density_kg_m3 = 2600
material = "rock"
[[probe]]
name = "inside"
kind = "velocity"
position_m = [0.16, 0.08, 0.12]
[[probe]]
name = "beside"
kind = "velocity"
position_m = [0.23, 0.08, 0.12]
)";
  const scene::ScratchFolder scratch;
  run_to_folder(scene::load_text(text, {"run.duration_s=0.05", "run.series_interval_s=0.01"}),
                {.out = scratch.path() / "out", .threads = 1, .quiet = true}, run_scene);
  const Series series = read_series(scratch.path() / "out/series.h5");
  for (std::size_t row = 1; row < series.time_s.size(); ++row) {
    EXPECT_TRUE(std::isnan(series.find("inside_z_m_s")->values[row])) << row;
    EXPECT_GT(series.find("beside_z_m_s")->values[row], 0) << row << ": what sinks pushes water up";
  }
}

/// Of two grains the one nearest to the point is followed: it falls freely, then is gone.
TEST(Probes, FollowAGrain) {
  const std::string text = R"([scene]
name = "falling"
[run]
duration_s = 0.6
series_interval_s = 0.1
[domain]
lower_m = [0, 0, 0]
upper_m = [1, 1, 1]
open_faces = ["z-"]
[materials.rock]
youngs_modulus_Pa = 1e7
poisson_ratio = 0.3
[[grains.sphere]]
position_m = [0.2, 0.2, 0.8]
diameter_m = 0.1
density_kg_m3 = 2500
material = "rock"
[[grains.sphere]]
position_m = [0.6, 0.5, 0.8]
velocity_m_s = [0.5, 0, 0]
diameter_m = 0.1
density_kg_m3 = 2500
material = "rock"
[[probe]]
name = "stone"
kind = "grain"
position_m = [0.55, 0.5, 0.8]
)";
  const scene::ScratchFolder scratch;
  const RunResult result =
      run_to_folder(scene::load_text(text), {.out = scratch.path() / "out", .threads = 1, .quiet = true}, run_scene);
  const Series series = read_series(scratch.path() / "out/series.h5");
  const auto value = [&](const char* name, std::size_t row) { return series.find(name)->values.at(row); };
  for (std::size_t row = 0; row <= 3; ++row) {
    const double t = series.time_s[row];
    EXPECT_NEAR(value("stone_x_m", row), 0.6 + 0.5 * t, 1e-6);
    EXPECT_NEAR(value("stone_z_m", row), 0.8 - 0.5 * 9.81 * t * t, 1e-3);
    EXPECT_NEAR(value("stone_z_m_s", row), -9.81 * t, 1e-3);
  }
  EXPECT_TRUE(std::isnan(series.find("stone_x_m")->values.back()));
  EXPECT_GT(result.summary.metrics.at("stone_speed_peak_m_s"), 3);
}

}  // namespace
}  // namespace lahar::cases
