// The time step of the fluid in a run: adaptive, and bounded by surface tension.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/assembly/build.h"
#include "cases/files/series_reader.h"
#include "cases/runner/check.h"
#include "cases/runner/run.h"
#include "core/check.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

/// A dam break whose largest speed is guessed at an eighth of what it is.
const std::string guessed = R"([scene]
name = "dam"
[run]
duration_s = 0.5
[domain]
lower_m = [0, 0, 0]
upper_m = [0.6, 0.16, 0.4]
open_faces = ["z+"]
[fluid]
enabled = true
cell_size_m = 0.02
max_speed_m_s = 0.3
adaptive_time_step = true
[[fluid.region]]
lower_m = [0, 0, 0]
upper_m = [0.2, 0.16, 0.3]
)";

TEST(TimeStep, AdaptsInARun) {
  const scene::ScratchFolder scratch;
  const scene::Scene scene = scene::load_text(guessed);
  const RunResult result =
      run_to_folder(scene, {.out = scratch.path() / "out", .threads = 1, .quiet = true}, run_scene);
  const auto& metrics = result.summary.metrics;
  const double first = fluid_time_step(scene);
  EXPECT_NEAR(result.summary.simulated_seconds, 0.5, first);
  EXPECT_GE(metrics.at("fluid_time_step_changes"), 1);
  EXPECT_LT(metrics.at("fluid_time_step_min_s"), 0.4 * first);
  EXPECT_GE(metrics.at("fluid_time_step_max_s"), metrics.at("fluid_time_step_min_s"));
  EXPECT_LT(metrics.at("liquid_mass_drift_rel"), 1e-6);
  // Compressed by half in the units of the first step, which is taken before the first look; the volume is what stays.
  // 3 g h = 0.98 at the bottom, and rho = exp(3 g h).
  EXPECT_NEAR(metrics.at("liquid_mass_start_kg"), std::expm1(0.98) / 0.98 * 9.6, 0.1);
  EXPECT_NEAR(metrics.at("liquid_mass_start_kg") + metrics.at("liquid_rescaled_kg"), 9.6, 0.04 * 9.6);
  const Series series = read_series(scratch.path() / "out/series.h5");
  EXPECT_NEAR(series.find("fluid_time_step_s")->values.back(), metrics.at("fluid_time_step_min_s"), 0.5 * first);
  EXPECT_NE(report_text(scene, check_scene(scene)).find("follows the liquid"), std::string::npos);
}

/// The same with a fixed step is stopped.
TEST(TimeStep, OfAWrongGuessEndsAtTheWatchdog) {
  const scene::ScratchFolder scratch;
  scene::Scene scene = scene::load_text(guessed);
  scene.fluid.adaptive_time_step = false;
  EXPECT_THROW(run_to_folder(scene, {.out = scratch.path() / "out", .threads = 1, .quiet = true}, run_scene),
               NumericalFailure);
}

/// 0.1 x 0.02 m / 0.3 m/s = 6.7 ms; ripples of two cells on a liquid of 100 N/m allow sqrt(8e-3 / (400 pi)) = 2.5 ms.
TEST(TimeStep, IsHeldByRipples) {
  scene::Scene scene = scene::load_text(guessed);
  scene.fluid.adaptive_time_step = false;
  EXPECT_NEAR(fluid_time_step(scene), 6.667e-3, 1e-5);
  EXPECT_EQ(report_text(scene, check_scene(scene)).find("ripple"), std::string::npos);
  scene.fluid.surface_tension = 100;
  EXPECT_NEAR(fluid_time_step(scene), 2.523e-3, 1e-5);
  const lbm::FluidOptions o = fluid_options(scene);
  EXPECT_EQ(o.surface_tension, 100);
  EXPECT_NO_THROW(lbm::Fluid<float>{o});
  EXPECT_NE(report_text(scene, check_scene(scene)).find("ripple"), std::string::npos);
  EXPECT_NE(report_text(scene, check_scene(scene)).find("surface tension is modelled"), std::string::npos);
}

}  // namespace
}  // namespace lahar::cases
