#include "cases/observers/probes.h"

#include <gtest/gtest.h>

#include "cases/assembly/build.h"
#include "cases/files/series_reader.h"
#include "cases/runner/run.h"
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

}  // namespace
}  // namespace lahar::cases
