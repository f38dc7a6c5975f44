// The built executables: exit codes, what they print, and that bad input leaves nothing behind.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/cases/files/shape_texts.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {
namespace {

struct Outcome {
  int code = -1;
  std::string out, err;
};

/// Runs `BEFORE PROGRAM ARGUMENTS` in a folder of its own.
Outcome start(const std::string& before, const std::string& program, const std::string& arguments,
              const ScratchFolder& folder, const ScratchFolder& streams) {
  const std::string out = (streams.path() / "out").string(), err = (streams.path() / "err").string();
  const std::string command = "cd '" + folder.path().string() + "' && " + before + "'" + program + "' " + arguments +
                              " > '" + out + "' 2> '" + err + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, file_text(out), file_text(err)};
}

class Cli : public testing::Test {
 protected:
  Outcome run(const std::string& arguments, const std::string& before = "") {
    const ScratchFolder streams_beside_results;
    return start(before, LAHAR_EXECUTABLE, arguments, folder_, streams_beside_results);
  }
  /// Another one that stands beside it.
  Outcome run_other(const std::string& program, const std::string& arguments) {
    const ScratchFolder streams_beside_results;
    return start("", LAHAR_STUDIES "/" + program, arguments, folder_, streams_beside_results);
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }
  ScratchFolder folder_;
};

TEST_F(Cli, ChecksAGoodSceneAndWritesNothing) {
  const Outcome o = run("check '" + case_file("debris_flow/scene.toml").string() + "'");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("Rayleigh time"), std::string::npos);
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(files(), 0u);
}

/// What is printed may be lost to a full disk: that is no success.
TEST_F(Cli, AnOutputThatIsFullIsAFailure) {
  for (const std::string& command : {std::string("keys"), "check '" + case_file("dam_break/scene.toml").string() + "'"})
    EXPECT_EQ(run(command + " > /dev/full #").code, 1) << command;
}

/// So may a message be: the exit code stays what it is.
TEST_F(Cli, MessagesThatNobodyReadsChangeNothing) {
  for (const char* lost : {" 2>&- #", " 2> /dev/full #"}) {
    EXPECT_EQ(run(std::string("check nope.toml") + lost).code, 2) << lost;
    EXPECT_EQ(run(std::string("chek nope.toml") + lost).code, 2) << lost;
  }
}

TEST_F(Cli, QuantitiesTakeWhatARunTakes) {
  const std::string command = "quantities '" + case_file("bouncing_sphere/scene.toml").string() + "'";
  const Outcome o = run(command + " --threads 1 --out there --set measure.section_x_m=0.1");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("particle_arrival_s"), std::string::npos);
  EXPECT_EQ(run(command + " --quiet").out, "");
  EXPECT_EQ(run(command).out.find("particle_arrival_s"), std::string::npos);
  EXPECT_EQ(files(), 0u);
}

TEST_F(Cli, AnUnknownCommandIsNamed) {
  const Outcome o = run("chek scene.toml");
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.err,
            "command line:1:1: \"chek\" is no command (did you mean \"check\"?), expected one of run, resume, check, "
            "quantities, keys\n");
}

TEST_F(Cli, QuietIsQuiet) {
  const Outcome o = run("check --quiet '" + case_file("dam_break/scene.toml").string() + "'");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.out + o.err, "");
}

TEST_F(Cli, MistakesAreOneLineEachOnStderr) {
  folder_.write("bad.toml", small_scene + "[gravity]\nslope_degree = 1\nmagnitude_m_s2 = -1\n");
  for (const char* command : {"check", "run --out out"}) {
    const Outcome o = run(std::string(command) + " bad.toml --set run.duration_s=0");
    EXPECT_EQ(o.code, 2);
    EXPECT_EQ(o.out, "");
    EXPECT_NE(o.err.find("bad.toml:17:1: unknown key \"slope_degree\" in [gravity] (did you mean \"slope_deg\"?)"),
              std::string::npos)
        << o.err;
    EXPECT_NE(o.err.find("bad.toml:18:18: gravity.magnitude_m_s2 is -1, expected a number at least 0\n"),
              std::string::npos);
    EXPECT_NE(o.err.find("--set run.duration_s=0:1:1: run.duration_s is 0"), std::string::npos);
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 3);
    EXPECT_EQ(files(), 1u);
  }
}

TEST_F(Cli, MalformedFilesExitWithTwoAndLeaveNothing) {
  folder_.write("empty.toml", "");
  folder_.write("syntax.toml", "[scene\n");
  folder_.write("binary.toml", std::string("\x00\xff\x01\x80", 4));
  std::filesystem::create_directory(folder_.path() / "folder.toml");
  for (const char* name : {"empty.toml", "syntax.toml", "binary.toml", "folder.toml", "missing.toml"})
    for (const char* command : {"check ", "run --out out "}) {
      const Outcome o = run(command + std::string(name));
      EXPECT_EQ(o.code, 2) << name;
      EXPECT_TRUE(o.err.starts_with(std::string(name) + ":")) << o.err;
      EXPECT_EQ(files(), 4u) << name;
    }
}

TEST_F(Cli, AFileThatIsNoMeshIsAMistakeOfItsKey) {
  folder_.write("scene.toml", small_scene + "[[wall]]\nshape = \"mesh\"\nfile = \"scrap.stl\"\nmaterial = \"rock\"\n");
  folder_.write("scrap.stl", "solid scrap\nvertex 0 0\n");
  for (const char* command : {"check scene.toml", "run scene.toml --out out"}) {
    const Outcome o = run(command);
    EXPECT_EQ(o.code, 2);
    EXPECT_TRUE(o.err.starts_with("scene.toml:18:8: wall[0].file: \"")) << o.err;
    EXPECT_NE(o.err.find("scrap.stl\" line 2: expected \"vertex x y z\"\n"), std::string::npos) << o.err;
    EXPECT_EQ(files(), 2u);
  }
}

/// Its absolute name could not stand in the resolved scene.
TEST_F(Cli, AMeshInAFolderThatIsNotUtf8IsRefused) {
  const std::string folder = "Gerinne \xfc";
  std::filesystem::create_directory(folder_.path() / folder);
  folder_.write(folder + "/scene.toml",
                small_scene + "[[wall]]\nshape = \"mesh\"\nfile = \"block.stl\"\nmaterial = \"rock\"\n");
  folder_.write(folder + "/block.stl", cases::stl_text(box_mesh(Vec3(0.7, 0.7, 0), Vec3(0.9, 0.9, 0.2))));
  for (const char* command : {"check", "run --out out"}) {
    const Outcome o = run(std::string(command) + " '" + folder + "/scene.toml'");
    EXPECT_EQ(o.code, 2);
    EXPECT_TRUE(o.err.starts_with(folder + "/scene.toml:18:8: wall[0].file: \"")) << o.err;
    EXPECT_TRUE(o.err.ends_with("block.stl\" is not UTF-8, expected folders whose names are\n")) << o.err;
    EXPECT_EQ(files(), 1u);
  }
}

TEST_F(Cli, BadCommandLinesExitWithTwo) {
  for (const char* arguments : {"", "fly", "run", "check a.toml b.toml", "run --threads 0 a.toml", "run --set"}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  }
}

TEST_F(Cli, WordsOfTheCommandLineAreShownOnOneLine) {
  EXPECT_EQ(run("check 'no\nsuch.toml'").err,
            "no\\u000Asuch.toml:0:0: there is no such file, expected a scene (TOML)\n");
  const std::string unknown = run("'fly\x1b'").err;
  EXPECT_TRUE(unknown.starts_with("command line:1:1: \"fly\\u001B\" is no command")) << unknown;
}

TEST_F(Cli, WhatAProgramHasNoUseForIsUnknownToIt) {
  const std::vector<std::pair<std::string, std::string>> command_lines{
      {"lahar", "check scene.toml --overwrite"}, {"lahar", "resume folder --out out"},
      {"lahar", "resume folder --overwrite"},    {"validate", "--list --overwrite"},
      {"benchmark", "--list --overwrite"},       {"compare_cfd_dem", "--list --overwrite"}};
  for (const auto& [program, arguments] : command_lines) {
    const Outcome o = run_other(program, arguments);
    EXPECT_EQ(o.code, 2) << program << " " << arguments;
    EXPECT_TRUE(o.err.starts_with("command line:1:1: ")) << o.err;
    EXPECT_NE(o.err.find("not expected"), std::string::npos) << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
    EXPECT_EQ(files(), 0u) << program << " " << arguments;
  }
}

TEST_F(Cli, WhatAProgramCannotTakeIsRefusedWithTheReason) {
  const std::vector<std::tuple<std::string, std::string, std::string>> command_lines{
      {"validate", "--set a.b=1 --out out", "--set a.b=1: the entries have no keys to set"},
      {"hard_cases", "--set a.b=1 --out out", "--set a.b=1: hard cases have no keys to set"},
      {"benchmark", "--set a.b=1 --out out", "--set a.b=1: benchmarks have no keys to set"},
      {"speed_error", "--set a.b=1 --out out", "--set a.b=1: the study turns its own knobs"},
      {"benchmark", "--precision float --out out", "--precision: each entry has its own"},
      {"speed_error", "--precision float --out out", "--precision: the study turns this knob itself"},
      {"compare_cfd_dem", "--precision double --records r --out out", "--records with --set or --precision"},
      {"lahar", "run scene.toml --out ''", "--out: is empty"},
      {"lahar", "resume ''", "folder: is empty"},
      {"validate", "fluid.tow --out out", "no entry or group is called 'fluid.tow'"},
      {"hard_cases", "H21 --out out", "no hard case is called 'H21'"},
      {"speed_error", "dambreak --out out", "dambreak"},
      {"benchmark", "fluid.plane --out out", "did you mean 'fluid.plain'?"}};
  for (const auto& [program, arguments, reason] : command_lines) {
    const Outcome o = run_other(program, arguments);
    EXPECT_EQ(o.code, 2) << program << " " << arguments;
    EXPECT_TRUE(o.err.starts_with("command line:1:1: ")) << o.err;
    EXPECT_NE(o.err.find(reason), std::string::npos) << o.err;
    EXPECT_EQ(files(), 0u) << program << " " << arguments;
  }
}

TEST_F(Cli, AListMakesNoFolder) {
  for (const char* program : {"validate", "hard_cases", "speed_error", "benchmark", "compare_cfd_dem"}) {
    const Outcome o = run_other(program, "--list --out out");
    EXPECT_EQ(o.code, 0) << program << " " << o.err;
    EXPECT_NE(o.out, "") << program;
    EXPECT_EQ(files(), 0u) << program;
  }
}

TEST_F(Cli, HelpVersionAndKeys) {
  EXPECT_EQ(run("--help").code, 0);
  EXPECT_NE(run("run --help").out.find("--set"), std::string::npos);
  for (const char* program :
       {"lahar", "validate", "hard_cases", "speed_error", "benchmark", "compare_cfd_dem", "ring_pull"})
    EXPECT_TRUE(run_other(program, "--version").out.starts_with(program + std::string(" "))) << program;
  const Outcome keys = run("keys");
  EXPECT_EQ(keys.code, 0);
  EXPECT_EQ(keys.out, file_text(source_folder() / "docs/scene_reference.md"));
}

TEST_F(Cli, ARunIsReproducedByItsResolvedScene) {
  const std::string run_it = "run --threads 1 --quiet ";
  ASSERT_EQ(
      run(run_it + "'" + case_file("bouncing_sphere/scene.toml").string() + "' --set run.duration_s=0.4 --out a").code,
      0);
  EXPECT_EQ(run(run_it + "a/scene.resolved.toml --out b").code, 0);
  EXPECT_EQ(file_text(folder_.path() / "a/scene.resolved.toml"), file_text(folder_.path() / "b/scene.resolved.toml"));
  const auto metrics = [&](const char* name) {
    return nlohmann::json::parse(file_text(folder_.path() / name / "summary.json"))["metrics"];
  };
  EXPECT_EQ(metrics("a"), metrics("b"));
  const Outcome again = run(run_it + "a/scene.resolved.toml --out b");
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find("holds a former run"), std::string::npos) << again.err;
  EXPECT_EQ(run(run_it + "a/scene.resolved.toml --out b --overwrite").code, 0);
}

TEST_F(Cli, AnInterruptedRunEndsWithReadableFiles) {
  for (const char* signal : {"INT", "TERM"}) {
    const Outcome o =
        run("run --threads 1 --overwrite --set run.duration_s=1e6 --set run.series_interval_s=1e3 --out out '" +
                case_file("bouncing_sphere/scene.toml").string() + "'",
            std::string("timeout --preserve-status -s ") + signal + " 0.5 ");
    EXPECT_EQ(o.code, 130) << signal;
    EXPECT_NE(o.out.find("interrupted"), std::string::npos) << o.out;
    const auto json = nlohmann::json::parse(file_text(folder_.path() / "out/summary.json"));
    EXPECT_GT(json["simulated_seconds"].get<double>(), 0);
    EXPECT_LT(json["simulated_seconds"].get<double>(), 1e6);
  }
}

TEST_F(Cli, AnInterruptedRunGoesOn) {
  const Outcome first =
      run("run --threads 1 --quiet --set run.duration_s=1e6 --set run.series_interval_s=1e3 --out out '" +
              case_file("bouncing_sphere/scene.toml").string() + "'",
          "timeout --preserve-status -s INT 2 ");
  EXPECT_EQ(first.code, 130);
  const auto summary = [&] { return nlohmann::json::parse(file_text(folder_.path() / "out/summary.json")); };
  const double until = summary()["simulated_seconds"].get<double>(), wall = summary()["wall_seconds"].get<double>();
  const Outcome rest = run("resume out --threads 2 --set run.duration_s=" + std::to_string(until + 0.1));
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_NE(rest.out.find("results are in out"), std::string::npos) << rest.out;
  EXPECT_NEAR(summary()["simulated_seconds"].get<double>(), until + 0.1, 1e-3);
  EXPECT_GT(summary()["wall_seconds"].get<double>(), wall);
}

/// While grains are packed, or the net comes to rest: the former run is there still, aside or in its place.
TEST_F(Cli, ASignalWhileARunIsPreparedEndsItAndLosesNothing) {
  const std::string options = "run --threads 1 --quiet --overwrite --out out ";
  const auto scene = [](const char* name) {
    return fmt::format("'{}' --set run.duration_s=0.01", case_file(name).string());
  };
  ASSERT_EQ(run(options + scene("bouncing_sphere/scene.toml")).code, 0);
  const std::string former = file_text(folder_.path() / "out/series.h5");
  ASSERT_NE(former, "");
  const auto kept = [&] {
    const auto aside = folder_.path() / "out/.former_run/series.h5";
    return file_text(std::filesystem::exists(aside) ? aside : folder_.path() / "out/series.h5");
  };
  for (const std::string& preparing :
       {scene("graded_gravel/scene.toml") + " --set 'grains.packing[0].target_height_m=0.34'",
        scene("hanging_net/scene.toml") + " --set barrier.settle_time_s=1000"})
    for (const char* after : {"0.05", "1"}) {
      const Outcome o = run(options + preparing, std::string("timeout --preserve-status -k 20 -s TERM ") + after + " ");
      constexpr int not_yet_listening = 128 + SIGTERM;  // as the program is loaded
      EXPECT_TRUE(o.code == 130 || (o.code == not_yet_listening && after == std::string("0.05")))
          << preparing << " after " << after << " s: " << o.code << " " << o.err;
      EXPECT_EQ(o.err.starts_with("interrupted before the run began\n"), o.code == 130) << o.err;
      EXPECT_EQ(kept(), former) << preparing << " after " << after << " s";
    }
}

/// A thousand spans; a net of 1e5 rings: within seconds of CPU.
TEST_F(Cli, WhatLargeBarriersTakeIsSaidAtOnce) {
  const std::string spans = "two_spans/scene.toml' --set barrier.posts.spans=1000 --set 'domain.upper_m=[0.3,300,0.4]'";
  const std::string rings =
      "hanging_net/scene.toml' --set barrier.net.width_m=60 --set barrier.net.height_m=6 "
      "--set 'domain.lower_m=[-1,-1,-1]' --set 'domain.upper_m=[1,61,8]'";
  for (const std::string& scene : {spans, rings}) {
    const Outcome o = run("check '" + case_file("").string() + scene, "ulimit -t 5; ");
    EXPECT_EQ(o.code, 0) << scene << ": " << o.err;
    EXPECT_NE(o.out.find("run time, a rough estimate"), std::string::npos) << o.out;
  }
}

/// The scenes whose features tools/pay_for_use measures are taken as they are.
TEST_F(Cli, ScenesOfPayForUseAreSound) {
  if (std::system("python3 --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no python3";
  const ScratchFolder streams;
  const Outcome o =
      start("", source_folder() / "tools/pay_for_use", "--check --lahar '" LAHAR_EXECUTABLE "'", folder_, streams);
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("are sound"), std::string::npos) << o.out;
}

TEST_F(Cli, ResumeRefusesWhatItCannotDo) {
  for (const char* arguments : {"resume", "resume nowhere", "resume nowhere --out elsewhere", "resume . --overwrite"}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
    EXPECT_EQ(files(), 0u);
  }
}

/// In its own folder, too, a run is named.
TEST_F(Cli, ResumeTakesNoEmptyName) {
  const std::string scene = case_file("bouncing_sphere/scene.toml").string();
  ASSERT_EQ(run(fmt::format("run --threads 1 --quiet --set run.duration_s=0.01 --out . '{}'", scene)).code, 0);
  const std::string log = file_text(folder_.path() / "run.log");
  const Outcome o = run("resume ''");
  EXPECT_EQ(o.code, 2);
  EXPECT_TRUE(o.err.starts_with("command line:1:1: folder: is empty")) << o.err;
  EXPECT_EQ(file_text(folder_.path() / "run.log"), log);
}

/// Results may be removed to save room: what is left tells of the run.
TEST_F(Cli, TheRecordOfARunIsKept) {
  folder_.write("scene.toml", small_scene);
  const std::string again = "run --threads 1 --quiet scene.toml --set run.duration_s=0.01 --out out";
  ASSERT_EQ(run(again).code, 0);
  const auto scene_file = folder_.path() / "out/scene.resolved.toml", log_file = folder_.path() / "out/run.log";
  const std::string scene = file_text(scene_file), log = file_text(log_file);
  const std::vector<std::filesystem::directory_entry> entries(
      std::filesystem::directory_iterator(folder_.path() / "out"), {});
  for (const auto& entry : entries)
    if (entry.path() != scene_file && entry.path() != log_file) std::filesystem::remove(entry.path());
  const Outcome o = run(again);
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("holds a former run"), std::string::npos) << o.err;
  EXPECT_EQ(file_text(scene_file), scene);
  EXPECT_EQ(file_text(log_file), log);
  EXPECT_EQ(run(again + " --overwrite").code, 0);
}

TEST_F(Cli, ExistingResultsAreKept) {
  folder_.write("scene.toml", small_scene);
  std::filesystem::create_directory(folder_.path() / "out");
  folder_.write("out/thesis.txt", "years of work");
  for (const char* options : {"", " --overwrite"}) {
    const Outcome o = run(std::string("run scene.toml --out out") + options);
    EXPECT_EQ(o.code, 2);
    EXPECT_NE(o.err.find("--out out:1:1: is not empty and holds no former run"), std::string::npos) << o.err;
  }
  EXPECT_EQ(file_text(folder_.path() / "out/thesis.txt"), "years of work");
}

}  // namespace
}  // namespace lahar::scene
