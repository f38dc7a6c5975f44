// What `lahar check` says a run takes.
#include "cases/runner/run_time.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <utility>

#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::load;

double run_time_of(const std::string& file, const std::vector<std::string>& set) {
  return check_scene(load(case_file(file), set)).run_time;
}

/// One at the start and one at the end, those between, no more than one a step.
TEST(RunTime, CountsPictures) {
  const auto pictures = [](const std::string& interval) {
    const std::string of = "dam_break/scene.toml";
    const auto time = [&](const std::string& i) {
      return run_time_of(of, {"run.duration_s=1", "run.image_interval_s=" + i});
    };
    return (time(interval) - time("0")) / (time("1") - time("0")) * 2;
  };
  EXPECT_NEAR(pictures("0.025"), 41, 1e-6);
  EXPECT_NEAR(pictures("2"), 2, 1e-6);
  EXPECT_NEAR(pictures("0.6"), 3, 1e-6);
  EXPECT_NEAR(pictures("1e-7"),
              1 + check_scene(load(case_file("dam_break/scene.toml"), {"run.duration_s=1"})).fluid->steps, 1e-3);
}

/// A row looks at all that is wet and all particles, frames and checkpoints write them: each as often as it is due.
TEST(RunTime, CountsRowsFramesAndCheckpoints) {
  const std::string tank = "dam_break/scene.toml", net = "hanging_net/scene.toml";
  for (const auto& [file, key] : {std::pair{tank, "series"},
                                  {net, "series"},
                                  {tank, "output"},
                                  {net, "output"},
                                  {tank, "checkpoint"}}) {  // checkpoints are counted by their cells
    const auto time = [&](const char* interval) {
      return run_time_of(file, {"run.duration_s=1", fmt::format("run.{}_interval_s={}", key, interval)});
    };
    const double once = time("1"), seldom = time("0.02") - once, often = time("0.01") - once;
    EXPECT_GT(seldom, 0) << file << " " << key;
    EXPECT_NEAR(often / seldom, 99.0 / 49, 1e-6) << file << " " << key;
  }
}

/// As tools/pay_for_use measures it: a row every 5 steps makes the run of a small tank 1.37 times as long.
TEST(RunTime, RowsCostAboutWhatTheyWereMeasuredAt) {
  const auto time = [](const std::string& interval) {
    return run_time_of("dam_break/scene.toml", {"fluid.cell_size_m=0.0075", "run.duration_s=0.4", "probe=[]",
                                                "run.output_interval_s=0", "run.series_interval_s=" + interval});
  };
  EXPECT_NEAR(time("0.001") / time("0.1"), 1.37, 0.15);
  const CheckReport report =
      check_scene(load(case_file("dam_break/scene.toml"), {"fluid.cell_size_m=0.0075", "run.duration_s=0.4"}));
  EXPECT_NEAR((time("1e-9") - time("0.1")) / (time("0.001") - time("0.1")), (report.fluid->steps - 4) / 396, 1e-6);
}

/// Interface cells cost more than those inside: thin liquid takes longer than as much of deep liquid.
TEST(RunTime, ThinLiquidTakesLonger) {
  const auto a_cell = [](const std::string& upper) {
    const CheckReport report =
        check_scene(load(case_file("dam_break/scene.toml"), {"fluid.region[0].upper_m=" + upper}));
    return report.run_time / (report.fluid->steps * report.fluid->mean_cells);
  };
  EXPECT_GT(a_cell("[1.6, 0.3, 0.04]"), 2 * a_cell("[0.5, 0.3, 0.78]"));
}

/// Cells of doubles are half as many in a vector and in the cache; particles are doubles either way.
TEST(RunTime, DoubleTakesLongerInTheFluidAlone) {
  const auto ratio = [](const char* file) {
    return run_time_of(file, {"run.precision=double"}) / run_time_of(file, {"run.precision=float"});
  };
  EXPECT_NEAR(ratio("dam_break/scene.toml"), 1.6, 1e-9);
  EXPECT_EQ(ratio("bouncing_sphere/scene.toml"), 1);
  const double both = ratio("compare_cfd_dem/matched.toml");
  EXPECT_GT(both, 1.1);
  EXPECT_LT(both, 1.5);
}

/// The smaller the smallest grain the shorter the steps of a packing, and the more of them, whatever the density.
TEST(RunTime, CountsPackings) {
  const auto prepared = [](const std::string& smallest, const std::string& density) {
    return run_time_of(
        "graded_gravel/scene.toml",
        {"run.duration_s=1e-4", "grains.packing[0].sieve_curve=[]",
         "grains.packing[0].sizes=[{diameter_m = 0.03, count = 200, material = \"rock\", density_kg_m3 = " + density +
             "}, {diameter_m = " + smallest + ", count = 1, material = \"rock\", density_kg_m3 = " + density + "}]"});
  };
  const double coarse = prepared("0.03", "2650");
  EXPECT_GT(prepared("0.006", "2650"), 2 * coarse);
  EXPECT_NEAR(prepared("0.03", "1000"), coarse, 0.01 * coarse);
}

/// Smooth wires cost by the places where they touch.
TEST(RunTime, CountsLinksOfSmoothWires) {
  const auto links = [](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> beads{"solids.wire_contacts=beads"}, smooth{"solids.wire_contacts=capsules"};
    beads.insert(beads.end(), more.begin(), more.end());
    smooth.insert(smooth.end(), more.begin(), more.end());
    return run_time_of(file, smooth) - run_time_of(file, beads);
  };
  const std::string net = "hanging_net/scene.toml";
  const double once = links(net, {});
  EXPECT_GT(once, 0);
  EXPECT_GT(links(net, {"barrier.settle_time_s=0.5"}), 1.2 * once);
  EXPECT_EQ(links("hexagonal_net/scene.toml", {}), 0);
}

TEST(RunTime, MoreThreadsAreFaster) {
  const scene::Scene hanging = scene::debris_flow();
  EXPECT_NEAR(check_scene(hanging, 1).run_time / check_scene(hanging, 4).run_time, 4, 1e-9);
  scene::Scene as_built = hanging;
  as_built.barrier.settle_time = 0;
  EXPECT_GT(check_scene(hanging, 1).run_time, check_scene(as_built, 1).run_time);
}

/// By the contacts of grains, which then take longer steps.
TEST(RunTime, TwoRatesAreFaster) {
  const auto report = [](const char* two_rates) {
    return check_scene(load(case_file("compare_cfd_dem/matched.toml"),
                            {"materials.rock.youngs_modulus_Pa=3.5e9", fmt::format("solids.two_rates={}", two_rates)}));
  };
  const CheckReport one = report("false"), two = report("true");
  EXPECT_EQ(one.solids->long_step, 1);
  EXPECT_GT(two.solids->long_step, 2);
  EXPECT_LT(two.run_time, 0.9 * one.run_time);
  EXPECT_GT(two.run_time, 0.5 * one.run_time);
}

/// The net settles with its own mass: what that takes does not shrink with the steps of slow beads.
TEST(RunTime, HangingTakesAsLongWithSlowBeads) {
  const auto hanging = [](double mass_scale) {
    scene::Scene with = scene::debris_flow();
    with.barrier.net.bead_mass_scale = mass_scale;
    scene::Scene without = with;
    without.barrier.settle_time = 0;
    return check_scene(with).run_time - check_scene(without).run_time;
  };
  EXPECT_GT(hanging(1), 1);
  EXPECT_NEAR(hanging(10) / hanging(1), 1, 1e-6);
}

}  // namespace
}  // namespace lahar::cases
