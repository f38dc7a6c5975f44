#include "cases/runner/table_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "cases/hard_cases/hard_cases.h"
#include "cases/speed_error/report.h"
#include "cases/validate/entry.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::file_text;
using scene::ScratchFolder;

const std::string table = "# machine, 2020-02-29\nid,value\nH1,3\n";

TEST(TableFolder, AFormerTableIsReplacedOnlyOnDemand) {
  const ScratchFolder scratch;
  prepare_table_folder(scratch.path() / "new", "a.csv", "id,value", false);
  EXPECT_TRUE(std::filesystem::is_directory(scratch.path() / "new"));
  prepare_table_folder(scratch.path() / "new", "a.csv", "id,value", false);  // empty: may be used
  const auto file = scratch.write("new/a.csv", table);
  EXPECT_THROW(prepare_table_folder(scratch.path() / "new", "a.csv", "id,value", false), InputError);
  EXPECT_NO_THROW(prepare_table_folder(scratch.path() / "new", "a.csv", "id,value", true));
  EXPECT_EQ(file_text(file), table);
}

TEST(TableFolder, ForeignFilesAreNeverTouched) {
  const ScratchFolder scratch;
  for (const char* text : {"", "id,worth\n", "# id,value\n", "years of work"}) {
    scratch.write("a.csv", text);
    for (const bool overwrite : {false, true})
      EXPECT_THROW(prepare_table_folder(scratch.path(), "a.csv", "id,value", overwrite), InputError) << text;
  }
  EXPECT_THROW(prepare_table_folder(scratch.path() / "a.csv", "a.csv", "id,value", true), InputError);
}

/// Exit code of a program of the folder of executables.
int run(const std::string& program, const std::string& arguments) {
  const int status = std::system(("'" LAHAR_STUDIES "/" + program + "' " + arguments + " > /dev/null 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The executables refuse before they run anything.
TEST(TableFolder, IsThatOfTheStudies) {
  const ScratchFolder scratch;
  const std::string out = " --out '" + scratch.path().string() + "'";
  const std::string former = validate::results_csv({}, {}, "2020-02-29");
  const auto hard_cases = scratch.write(validate::kHardCasesTable, former);
  EXPECT_EQ(run("hard_cases", "L5 --quick" + out), 2);
  EXPECT_EQ(file_text(hard_cases), former);
  EXPECT_EQ(run("speed_error", "elastic_impact --quick" + out), 2) << "a folder of another study";
  const std::string sitting = validate::results_csv({}, validate::Sitting{});
  const auto speed_error = scratch.write(validate::kSpeedErrorTable, sitting);
  EXPECT_EQ(run("speed_error", "elastic_impact --quick" + out), 2);
  EXPECT_EQ(file_text(speed_error), sitting);
}

TEST(ValidateRecord, OfAnotherProgramIsRefused) {
  const ScratchFolder scratch;
  const auto file = scratch.write("notes.json", "{\"entries\": \"mine\"}");
  EXPECT_EQ(run("validate", "dem.damped_impact --quick --json '" + file.string() + "'"), 2);
  EXPECT_EQ(file_text(file), "{\"entries\": \"mine\"}");
}

TEST(BenchmarkRecord, OfAnotherProgramIsRefused) {
  const ScratchFolder scratch;
  for (const std::string text : {"precious = 1", "{\"machine\": 1, \"commit\": 2, \"entries\": [{\"rows\": []}]}"}) {
    const auto file = scratch.write("scene.toml", text);
    EXPECT_EQ(run("benchmark", "fluid.sparse_memory --repeats 1 --json '" + file.string() + "'"), 2);
    EXPECT_EQ(file_text(file), text);
  }
}

TEST(BenchmarkFolder, IsRefusedBeforeTheWorkWhereSomethingElseIsInTheWay) {
  const ScratchFolder scratch;
  std::filesystem::create_directories(scratch.path() / "debris_flow/slice");
  const auto thesis = scratch.write("debris_flow/slice/thesis.txt", "years of work");
  EXPECT_EQ(run("benchmark", "debris_flow.packed --repeats 1 --out '" + scratch.path().string() + "'"), 2);
  EXPECT_EQ(file_text(thesis), "years of work");
  EXPECT_EQ(run("benchmark", "fluid.sparse_memory --repeats 1 --out '" + thesis.string() + "'"), 2);
}

/// Exit code of a program that is interrupted after this time.
int interrupted_run(const char* seconds, const std::string& program, const std::string& arguments) {
  const int status = std::system(("timeout --preserve-status -s INT " + std::string(seconds) + " '" LAHAR_STUDIES "/" +
                                  program + "' " + arguments + " > /dev/null 2>&1")
                                     .c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// What comes in the last entry, or the only one, counts too.
TEST(Interruption, InTheOnlyEntryEndsWith130) {
  const ScratchFolder scratch;
  const std::string out = " --threads 1 --out '" + scratch.path().string() + "/";
  EXPECT_EQ(interrupted_run("0.2", "validate", "fluid.determinism --quick" + out + "v'"), 130);
  EXPECT_EQ(interrupted_run("0.2", "hard_cases", "H9 --quick" + out + "h'"), 130);
  EXPECT_EQ(interrupted_run("0.2", "speed_error", "elastic_impact --quick" + out + "s'"), 130);
}

}  // namespace
}  // namespace lahar::cases
