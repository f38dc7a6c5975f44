// The whole chain in small: water and grains run into a ring net; the books close and every output is there.
#include <gtest/gtest.h>

#include <filesystem>

#include "cases/assembly/load.h"
#include "cases/files/series_reader.h"
#include "cases/runner/run.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::cases {
namespace {

TEST(SmallDebrisFlow, BooksCloseAndOutputsAreThere) {
  const TestFolder files;
  const auto folder = files / "out";
  const scene::Scene scene = scene::load(LAHAR_SOURCE_DIR "/tests/integration/small_debris_flow.toml");
  RunOptions options;
  options.out = folder;
  options.quiet = true;
  const RunResult result = run_to_folder(scene, options, run_scene);
  const auto& m = result.summary.metrics;
  EXPECT_LT(m.at("liquid_mass_drift_rel"), 1e-5);
  EXPECT_LT(m.at("momentum_audit_rel"), 1e-6);
  for (const ResultCheck& check : result.summary.checks) EXPECT_TRUE(check.pass) << check.name;
  // The front runs 0.3 m to the net; a stone without friction takes 0.33 s, a dam break on the slope less.
  EXPECT_GT(m.at("front_arrival_s"), 0.1);
  EXPECT_LT(m.at("front_arrival_s"), 0.4);
  EXPECT_GT(m.at("particle_arrival_s"), 0.1);
  EXPECT_GT(m.at("retained_mass_ratio"), 0.8);
  EXPECT_GT(m.at("max_elongation_m"), 0.01);
  EXPECT_GT(m.at("peak_barrier_sum_kN"), 0.1);
  for (const char* file :
       {"summary.json", "series.h5", "particles.h5", "particles.xmf", "bonds.xmf", "fluid_000000.vdb",
        "image_000000.png", "cable_forces.png", "run.log", "scene.resolved.toml"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  const Series series = read_series(folder / "series.h5");
  EXPECT_GT(series.time_s.size(), 40U);
}

}  // namespace
}  // namespace lahar::cases
