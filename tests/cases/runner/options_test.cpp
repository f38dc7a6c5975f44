#include "cases/runner/options.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/check.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

/// Parses a command line of an app with the common options and a positional argument.
int parse(std::vector<std::string> words, CommonOptions& options, std::string& scene_file) {
  CLI::App app("test", "test");
  app.add_option("scene", scene_file);
  add_common_options(app, options);
  words.insert(words.begin(), "test");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  return parse_and_run(app, static_cast<int>(argv.size()), argv.data(), [] { return exit_done; });
}

TEST(Options, EveryOptionArrives) {
  CommonOptions o;
  std::string scene_file;
  EXPECT_EQ(parse({"--set", "a.b=1", "s.toml", "--set", "v=[1, 2, 3]", "--out", "d", "--threads", "3", "--precision",
                   "double", "--quiet", "--overwrite"},
                  o, scene_file),
            exit_done);
  EXPECT_EQ(scene_file, "s.toml");
  EXPECT_EQ(overrides_of(o), (std::vector<std::string>{"a.b=1", "v=[1, 2, 3]", "run.precision=double"}));
  const RunOptions run = run_options(o, scene::Scene{});
  EXPECT_EQ(run.out, "d");
  EXPECT_EQ(run.threads, 3);
  EXPECT_TRUE(run.quiet && run.overwrite);
}

TEST(Options, ResultsGoToTheNameOfTheSceneByDefault) {
  scene::Scene scene;
  scene.identity.name = "flow";
  EXPECT_EQ(run_options({}, scene).out, "results/flow");
}

TEST(Options, BadCommandLinesAreBadInput) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"--bogus"}, {"--threads", "0"}, {"--threads", "x"}, {"--precision", "half"}, {"--set"}, {"a", "b"}}) {
    CommonOptions o;
    std::string scene_file;
    EXPECT_EQ(parse(words, o, scene_file), exit_bad_input) << words[0];
  }
}

TEST(Guarded, TurnsErrorsIntoExitCodes) {
  EXPECT_EQ(guarded([] { return exit_interrupted; }), 130);
  EXPECT_EQ(guarded([]() -> int { throw InputError("x"); }), 2);
  EXPECT_EQ(guarded([]() -> int { throw NumericalFailure("here", 1, "why"); }), 3);
  EXPECT_EQ(guarded([]() -> int { throw std::runtime_error("disk full"); }), 1);
}

/// What names of the user hold does no harm to a terminal.
TEST(Guarded, TellsEachOnALineOfItsOwn) {
  const auto told = [](const std::function<int()>& command) {
    testing::internal::CaptureStderr();
    guarded(command);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(
      told([]() -> int {
        throw InputError(std::vector<InputMistake>{{"a\nb.toml", 1, 2, "is \x1b[31m"}, {"c.toml", 3, 4, "is no"}});
      }),
      "a\\u000Ab.toml:1:2: is \\u001B[31m\nc.toml:3:4: is no\n");
  EXPECT_EQ(told([]() -> int { throw NumericalFailure("here", 1, "see a\nb"); }),
            "numerical failure: here, step 1: see a\\u000Ab\n");
  EXPECT_EQ(told([]() -> int { throw std::runtime_error("a\nb: disk full"); }), "error: a\\u000Ab: disk full\n");
}

}  // namespace
}  // namespace lahar::cases
