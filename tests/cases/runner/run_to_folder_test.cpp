#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "cases/files/series_reader.h"
#include "cases/runner/machine.h"
#include "cases/runner/output_folder.h"
#include "cases/runner/run.h"
#include "cases/scene/writer.h"
#include "core/parallel.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

scene::Scene bouncing() { return scene::load(scene::case_file("bouncing_sphere/scene.toml")); }

RunOptions quiet_into(const std::filesystem::path& out) { return {.out = out, .threads = 1, .quiet = true}; }

TEST(RunToFolder, LeavesSceneLogAndSummary) {
  const scene::ScratchFolder scratch;
  int threads = 0;
  const Runner runner = [&](const scene::Scene&, const RunOptions& options, RunMonitor& monitor) {
    EXPECT_TRUE(std::filesystem::exists(options.out / "scene.resolved.toml"));
    monitor.log.info("hello from the solver");
    threads = thread_count();
    RunResult result;
    result.summary.simulated_seconds = 1;
    result.summary.metrics["bounce_height_m"] = 0.3;
    return result;
  };
  run_to_folder(bouncing(), quiet_into(scratch.path() / "out"), runner);
  EXPECT_EQ(threads, 1);
  EXPECT_TRUE(holds_run(scratch.path() / "out"));
  EXPECT_TRUE(scene::load(scratch.path() / "out/scene.resolved.toml") == bouncing());
  const auto json = nlohmann::json::parse(scene::file_text(scratch.path() / "out/summary.json"));
  EXPECT_EQ(json["case"], "bouncing_sphere");
  EXPECT_EQ(json["version"], version());
  EXPECT_EQ(json["precision"], "float");
  EXPECT_EQ(json["metrics"]["bounce_height_m"], 0.3);
  EXPECT_GT(json["performance"]["peak_rss_bytes"].get<double>(), 1e6);
  const std::string log = scene::file_text(scratch.path() / "out/run.log");
  EXPECT_NE(log.find("hello from the solver"), std::string::npos);
  EXPECT_NE(log.find("warning: contacts are softened"), std::string::npos);
}

/// Liquid asked for inside a sphere, and around it.
TEST(RunToFolder, TellsWhereBodiesLeaveNoLiquid) {
  const auto log_of = [](const std::string& half) {
    const scene::ScratchFolder scratch;
    const scene::Scene scene = scene::load_text(
        scene::small_scene,
        {"run.duration_s=1e-4", "grains.sphere[0].diameter_m=0.4", "grains.sphere[0].fixed=true",
         "coupling.enabled=true",
         "fluid={enabled=true, cell_size_m=0.05, max_speed_m_s=2.0, region=[{lower_m=[0.4,0.4,0.4], upper_m=[" + half +
             "," + half + "," + half + "]}]}"});
    run_to_folder(scene, quiet_into(scratch.path() / "out"), run_scene);
    return scene::file_text(scratch.path() / "out/run.log");
  };
  EXPECT_NE(
      log_of("0.6").find("warning: at the start there is no liquid: walls and bodies fill all that is fluid.region"),
      std::string::npos);
  EXPECT_EQ(log_of("0.9").find("there is no liquid"), std::string::npos);
}

/// A ball without walls leaves through a face that is closed for water, and is gone; what flies up comes back.
TEST(RunToFolder, GrainsThatLeftTheDomainAreGone) {
  const auto kinetic_at_the_end = [](const std::string& velocity) {
    const scene::ScratchFolder scratch;
    const scene::Scene scene =
        scene::load_text(scene::small_scene, {"grains.sphere[0].velocity_m_s=" + velocity, "run.duration_s=0.4",
                                              "run.series_interval_s=0.1", "gravity.magnitude_m_s2=0"});
    run_to_folder(scene, quiet_into(scratch.path() / "out"), run_scene);
    return read_series(scratch.path() / "out/series.h5").find("grains_kinetic_J")->values.back();
  };
  EXPECT_EQ(kinetic_at_the_end("[5, 0, 0]"), 0);
  EXPECT_EQ(kinetic_at_the_end("[0, -5, 0]"), 0);
  EXPECT_GT(kinetic_at_the_end("[0, 0, 5]"), 0);
}

TEST(RunToFolder, AFailureIsLoggedAndPassedOn) {
  const scene::ScratchFolder scratch;
  const Runner runner = [](const scene::Scene&, const RunOptions&, RunMonitor&) -> RunResult {
    throw NumericalFailure("cell (1, 2, 3)", 17, "not a number");
  };
  EXPECT_THROW(run_to_folder(bouncing(), quiet_into(scratch.path() / "out"), runner), NumericalFailure);
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "out/summary.json"));
  EXPECT_NE(scene::file_text(scratch.path() / "out/run.log").find("error: cell (1, 2, 3), step 17: not a number"),
            std::string::npos);
}

/// The end comes between two looks of the watchdog: after the first step.
TEST(RunToFolder, NumbersThatWentWrongInTheLastStepsAreAFailure) {
  scene::Scene too_fast = scene::load(scene::case_file("dam_break/scene.toml"),
                                      {"fluid.cell_size_m=0.04", "run.duration_s=0.003", "gravity.magnitude_m_s2=0",
                                       "fluid.max_speed_m_s=1", "fluid.region[0].velocity_m_s=[8, 0, 0]"});
  scene::Scene not_finite = scene::load(scene::case_file("dam_break/scene.toml"), {"run.duration_s=0.3"});
  not_finite.fluid.max_speed = 0.01;
  for (scene::Scene scene : {too_fast, not_finite}) {
    const scene::ScratchFolder scratch;
    scene.run.checkpoint_wall = 0;
    EXPECT_THROW(run_to_folder(scene, quiet_into(scratch.path() / "out"), run_scene), NumericalFailure);
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "out/summary.json"));
  }
}

TEST(RunToFolder, AGrainThatWentWrongInTheLastStepsIsAFailure) {
  const scene::ScratchFolder scratch;
  const scene::Scene scene = scene::load_text(
      scene::small_scene, {"gravity.magnitude_m_s2=3.5e6", "run.duration_s=5e-5", "run.checkpoint_wall_s=0"});
  EXPECT_THROW(run_to_folder(scene, quiet_into(scratch.path() / "out"), run_scene), NumericalFailure);
}

/// One that is thrown out of the domain before the watchdog looks, too.
TEST(RunToFolder, AGrainThatIsThrownOutIsAFailure) {
  const scene::ScratchFolder scratch;
  const scene::Scene scene = scene::load(scene::case_file("bouncing_sphere/scene.toml"), {"solids.time_step_s=0.3"});
  EXPECT_THROW(run_to_folder(scene, quiet_into(scratch.path() / "out"), run_scene), NumericalFailure);
}

TEST(RunToFolder, OfTwoRunsInAFolderTheSecondIsRefused) {
  const scene::ScratchFolder scratch;
  const auto out = scratch.path() / "out";
  const Runner none = [](const scene::Scene&, const RunOptions&, RunMonitor&) { return RunResult{}; };
  int refused = 0;
  const Runner runner = [&](const scene::Scene& scene, const RunOptions&, RunMonitor&) {
    for (const bool resume : {false, true}) {
      RunOptions second = quiet_into(out);
      second.overwrite = !resume, second.resume = resume;
      try {
        run_to_folder(scene, second, none);
      } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("a run is going on there"), std::string::npos) << e.what();
        ++refused;
      }
    }
    EXPECT_TRUE(holds_run(out));
    return RunResult{};
  };
  run_to_folder(bouncing(), quiet_into(out), runner);
  EXPECT_EQ(refused, 2);
  RunOptions after = quiet_into(out);
  after.overwrite = true;
  run_to_folder(bouncing(), after, none);
}

/// The results of the run are whole all the same.
TEST(RunToFolder, ALastCheckpointThatCannotBeWrittenIsAFailure) {
  const scene::ScratchFolder scratch;
  const auto out = scratch.path() / "out";
  std::filesystem::create_directories(out / "checkpoint.h5.part/in_the_way");
  std::ofstream(out / "scene.resolved.toml") << scene::resolved_mark << "\n";
  RunOptions options = quiet_into(out);
  options.overwrite = true;
  const scene::Scene scene = scene::load_text(scene::small_scene, {"run.duration_s=0.01"});
  EXPECT_THROW(run_to_folder(scene, options, run_scene), FileError);
  const auto json = nlohmann::json::parse(scene::file_text(out / "summary.json"));
  EXPECT_NEAR(json["simulated_seconds"].get<double>(), 0.01, 1e-3);
  EXPECT_NE(scene::file_text(out / "run.log").find("error: " + (out / "checkpoint.h5").string()), std::string::npos);
}

/// Where there is no room to copy the rows for others the checkpoint is written all the same, and as the run ends its
/// files take their place.
TEST(RunToFolder, ACheckpointNeedsNoCopyOfTheRows) {
  const scene::ScratchFolder scratch;
  const auto out = scratch.path() / "out";
  std::filesystem::create_directories(out / "series.h5.part/in_the_way");
  std::ofstream(out / "scene.resolved.toml") << scene::resolved_mark << "\n";
  RunOptions options = quiet_into(out);
  options.overwrite = true;
  run_to_folder(scene::load_text(scene::small_scene, {"run.duration_s=0.01", "run.series_interval_s=0.001"}), options,
                run_scene);
  EXPECT_TRUE(std::filesystem::exists(out / "checkpoint.h5"));
  EXPECT_EQ(read_series(out / "series.h5").time_s.size(), 11U);
  EXPECT_NE(scene::file_text(out / "run.log").find("the run goes on"), std::string::npos);
}

/// Rates count from the first step: here a second goes by before.
TEST(RunToFolder, PreparationIsNoTimeOfAStep) {
  const scene::ScratchFolder scratch;
  spdlog::logger log("test");
  std::FILE* const told = std::tmpfile();
  Progress progress(1.0, ProgressStyle::lines, told);
  std::this_thread::sleep_for(std::chrono::seconds(1));
  RunMonitor monitor{progress, log};
  const auto start = std::chrono::steady_clock::now();
  run_scene(bouncing(), quiet_into(scratch.path()), monitor);
  const double mean = 1 / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::rewind(told);
  double rate = 0;
  ASSERT_EQ(std::fscanf(told, " 10 %%  t = %*f s of 1 s  %lf s/s", &rate), 1);
  std::fclose(told);
  EXPECT_GT(rate, 0.3 * mean);
}

TEST(RunToFolder, RefusesBeforeItRuns) {
  const scene::ScratchFolder scratch;
  scratch.write("mine.txt", "x");
  bool ran = false;
  const Runner runner = [&](const scene::Scene&, const RunOptions&, RunMonitor&) { return ran = true, RunResult{}; };
  EXPECT_THROW(run_to_folder(bouncing(), quiet_into(scratch.path()), runner), InputError);
  EXPECT_FALSE(ran);
}

}  // namespace
}  // namespace lahar::cases
