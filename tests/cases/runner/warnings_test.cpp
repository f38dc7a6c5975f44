// What `lahar check` and a run warn of.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/cases/runner/warns.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::load;

TEST(Warnings, KeysThatChangeNothing) {
  const auto report = [](const char* file, std::vector<std::string> set) {
    return check_scene(load(case_file(file), set));
  };
  const char* const two_rates = "solids.two_rates changes nothing";
  EXPECT_TRUE(warns(report("debris_flow/scene.toml", {"solids.two_rates=true"}), "less than twice that of the beads"));
  EXPECT_FALSE(
      warns(report("debris_flow/scene.toml", {"solids.two_rates=true", "solids.time_step_s=1e-6"}), two_rates));
  EXPECT_FALSE(warns(report("debris_flow/scene.toml", {}), two_rates));
  EXPECT_TRUE(warns(report("bouncing_sphere/scene.toml", {"solids.two_rates=true"}), "without fluid, grains and"));
  const char* const no_wires = "run.force_map_interval_s without a barrier";
  EXPECT_TRUE(warns(report("dam_break/scene.toml", {"run.force_map_interval_s=0.1"}), no_wires));
  EXPECT_FALSE(warns(report("debris_flow/scene.toml", {"run.force_map_interval_s=0.1"}), no_wires));
}

/// A key, what it is set to, what lets it have an effect.
TEST(Warnings, KeysThatNeedOthers) {
  const auto changes_nothing = [](const char* file, const std::string& key, std::vector<std::string> set) {
    return warns(check_scene(load(case_file(file), set)), key + " changes nothing");
  };
  const char *const dam = "dam_break/scene.toml", *const debris = "debris_flow/scene.toml",
                    *const ball = "bouncing_sphere/scene.toml";
  EXPECT_TRUE(changes_nothing(dam, "measure.outflow_distance_m", {"measure.outflow_distance_m=0.2"}));
  EXPECT_FALSE(changes_nothing(dam, "measure", {"measure.outflow_distance_m=0.2", "measure.section_x_m=1"}));
  EXPECT_TRUE(changes_nothing(dam, "measure.inflow_distance_m", {"measure.inflow_distance_m=0.2"}));
  EXPECT_TRUE(
      changes_nothing(ball, "measure.inflow_distance_m",
                      {"measure.inflow_distance_m=0.2", "measure.section_x_m=0", "measure.outflow_distance_m=0.2"}));
  EXPECT_FALSE(changes_nothing(dam, "measure", {}));
  EXPECT_TRUE(changes_nothing(dam, "fluid.uncounted_share", {"fluid.uncounted_share=0.01"}));
  EXPECT_FALSE(changes_nothing(dam, "fluid", {"fluid.uncounted_share=0.01", "fluid.adaptive_time_step=true"}));
  const std::string by_share = "coupling.body_weighting=solid_fraction", shift = "coupling.radius_shift_cells";
  EXPECT_TRUE(changes_nothing(debris, shift, {by_share, shift + "=-0.2"}));
  EXPECT_FALSE(changes_nothing(debris, shift, {by_share, shift + "=-0.06"}));
  EXPECT_FALSE(changes_nothing(debris, shift, {shift + "=-0.2"}));
  EXPECT_TRUE(changes_nothing(ball, "solids.bond_safety", {"solids.bond_safety=0.5", "solids.time_step_s=1e-5"}));
  EXPECT_TRUE(changes_nothing(ball, "solids.contact_safety", {"solids.contact_safety=0.1", "solids.time_step_s=1e-5"}));
  EXPECT_FALSE(changes_nothing(ball, "solids", {"solids.contact_safety=0.1"}));
}

/// Rows come at the first step that has reached their time; the dam's steps are 5.8e-4 s.
TEST(Warnings, RowsBetweenSteps) {
  const auto report = [](double steps, bool adaptive = false) {
    scene::Scene dam = scene::load(case_file("dam_break/scene.toml"));
    dam.run.series_interval = steps * check_scene(dam).fluid->time_step;
    dam.fluid.adaptive_time_step = adaptive;
    return check_scene(dam);
  };
  EXPECT_TRUE(warns(report(2.4), "is 2.4 time steps: rows come every 2 or 3 steps"));
  EXPECT_TRUE(warns(report(0.3), "rows come every 1 steps"));
  for (const double steps : {1.0, 2.0, 2.05, 8.4, 100.5}) EXPECT_FALSE(warns(report(steps), "rows come")) << steps;
  EXPECT_FALSE(warns(report(2.4, true), "rows come"));
}

TEST(Warnings, ARunShorterThanAStep) {
  const auto report = [](const char* file, double steps) {
    scene::Scene scene = load(case_file(file));
    const CheckReport whole = check_scene(scene);
    scene.run.duration = steps * (whole.fluid ? whole.fluid->time_step : whole.solids->time_step);
    return check_scene(scene);
  };
  for (const char* file : {"dam_break/scene.toml", "bouncing_sphere/scene.toml"}) {
    EXPECT_TRUE(warns(report(file, 1e-9), ") is shorter than a time step (")) << file;
    EXPECT_TRUE(warns(report(file, 0.5), "the run ends after one step at most")) << file;
    EXPECT_FALSE(warns(report(file, 1), "shorter than a time step")) << file;
  }
}

TEST(Warnings, ValuesInOtherUnits) {
  const auto report = [](const std::string& set) {
    return check_scene(load(case_file("debris_flow/scene.toml"), {set}));
  };
  EXPECT_TRUE(warns(report("contact[0].friction=30"), "it is a coefficient"));
  EXPECT_TRUE(warns(report("fluid.density_kg_m3=1.6"), "fluid.density_kg_m3 is 1.6"));
  EXPECT_TRUE(warns(report("barrier.anchors.cable_places=[]"), "no end of a cable but the bottom one is fixed"));
}

}  // namespace
}  // namespace lahar::cases
