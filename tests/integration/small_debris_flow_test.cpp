// The whole chain in small: water and grains run into a ring net; the books close and every output is there.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "cases/assembly/load.h"
#include "cases/files/series_reader.h"
#include "cases/runner/run.h"
#include "tests/cases/files/test_folder.h"
#include "tests/cases/observers/sampled.h"

namespace lahar::cases {
namespace {

/// Ns, of all that liquid and grains could get down the slope if nothing held them.
double impulse_of_weight(const scene::Scene& scene, double liquid, double time) {
  double mass = liquid;
  for (const auto& size : scene.grains.packings.at(0).sizes)
    mass += static_cast<double>(size.count) * size.density * M_PI / 6 * std::pow(size.diameter, 3);
  return mass * scene.gravity.vector().x() * time;
}

TEST(SmallDebrisFlow, BooksCloseAndOutputsAreThere) {
  const TestFolder files;
  const auto folder = files / "out";
  const scene::Scene scene =
      scene::load(LAHAR_SOURCE_DIR "/tests/integration/small_debris_flow.toml", {"run.force_map_interval_s=0.2"});
  RunOptions options;
  options.out = folder;
  options.quiet = true;
  const RunResult result = run_to_folder(scene, options, run_scene);
  const auto& m = result.summary.metrics;
  EXPECT_LT(m.at("liquid_mass_drift_rel"), 1e-5);
  EXPECT_LT(m.at("momentum_audit_rel"), 1e-6);
  std::set<std::string> checks;
  for (const ResultCheck& check : result.summary.checks) {
    EXPECT_TRUE(check.pass) << check.name;
    checks.insert(check.name);
  }
  EXPECT_EQ(checks, (std::set<std::string>{"grains_behind_walls", "liquid_mass_ledger", "momentum_audit",
                                           "ring_links_changed", "solids_energy_ledger"}));
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
  // Maps of the forces at 0, 0.2 and 0.4 s and at the end.
  EXPECT_TRUE(std::filesystem::exists(folder / "forces_000003.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "forces_000004.png"));
  const Series series = read_series(folder / "series.h5");
  EXPECT_GT(series.time_s.size(), 40U);
  // What the net gets in the rows is all that it gets: together less than the weight of water and grains could give, of
  // which water gave 3 % and grains 23 %.
  const double weight = impulse_of_weight(scene, m.at("liquid_mass_start_kg"), result.summary.simulated_seconds);
  double together = 0;
  for (const std::string& load : {std::string("fluid"), std::string("contact")}) {
    const double impulse = m.at("barrier_" + load + "_impulse_Ns");
    EXPECT_GT(impulse, 0.01 * weight) << load;
    EXPECT_NEAR(sum_over_time(series, "barrier_" + load + "_force_x_N"), impulse, 1e-9 * impulse) << load;
    together += impulse;
  }
  EXPECT_LT(together, weight);
}

}  // namespace
}  // namespace lahar::cases
