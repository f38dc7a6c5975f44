// What is done and what goes on, and the folder of a study.
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "cases/assembly/load.h"
#include "cases/compare_cfd_dem/jobs.h"
#include "cases/runner/options.h"
#include "cases/scene/writer.h"
#include "core/check.h"
#include "tests/cases/compare_cfd_dem/made_up_case.h"
#include "tests/cases/compare_cfd_dem/study_program.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::study {
namespace {

TEST(StudyFolder, ForeignFilesAreNeverTouched) {
  const cases::TestFolder folder;
  std::filesystem::create_directory(folder / "thesis");
  for (const char* name : {"report.html", "comparison.csv", "matched-L4.10-notes.json"})
    std::ofstream(folder / "thesis" / name) << "years of work";
  const std::string thesis = "'" + (folder / "thesis").string() + "'", own = "'" + (folder / "own").string() + "'";
  EXPECT_EQ(run_study("--report --out " + thesis, folder / "messages"), 2);
  EXPECT_NE(content_of(folder / "messages").find("--out " + (folder / "thesis").string() + ":1:1: is not empty"),
            std::string::npos);
  EXPECT_EQ(run_study("--report --out " + own + " --records " + thesis, folder / "messages"), 2);
  EXPECT_NE(content_of(folder / "messages").find("--records "), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "own"));
  for (const char* name : {"report.html", "comparison.csv", "matched-L4.10-notes.json"})
    EXPECT_EQ(content_of(folder / "thesis" / name), "years of work");
}

TEST(StudyFolder, MayHoldCasesRecordsOrTheTable) {
  const cases::TestFolder folder;
  const std::string name = made_up(4.1, 50, 10).study_case.name();
  for (const char* kind : {"new", "empty", "cases", "logs", "records", "table"})
    if (kind != std::string("new")) std::filesystem::create_directory(folder / kind);
  std::filesystem::create_directory(folder / "cases" / name);
  std::ofstream(folder / "cases" / "notes.txt") << "mine";
  std::ofstream(folder / "logs" / (name + ".log")) << "killed";
  std::ofstream(folder / "records" / (name + ".json")) << "{}";
  std::ofstream(folder / "table" / kComparisonTable) << comparison_csv({});
  for (const char* kind : {"new", "empty", "cases", "logs", "records", "table"})
    EXPECT_NO_THROW(require_study_folder(folder / kind, "--out")) << kind;
}

/// A mistyped folder holds no study.
TEST(StudyFolder, MustBeThereToBeReportedOf) {
  const cases::TestFolder folder;
  std::ofstream(folder / "file") << "mine";
  const std::string missing = "'" + (folder / "missing").string() + "'", file = "'" + (folder / "file").string() + "'";
  EXPECT_EQ(run_study("--report --out " + missing, folder / "messages"), 2);
  EXPECT_NE(content_of(folder / "messages").find("missing:1:1: does not exist"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "missing"));
  EXPECT_EQ(run_study("--list --out " + file, folder / "messages"), 2);
  EXPECT_NE(content_of(folder / "messages").find("file:1:1: is a file"), std::string::npos);
}

/// A study that is stopped leaves checkpoints and goes on; what is done is not run again; another scene is refused.
TEST(Jobs, GoOnAndAreNotRunTwice) {
  const cases::TestFolder folder;
  Selection selection{.sweeps = {"as_printed"}, .couplings = {"averaged"}, .releases = {1.85}};
  selection.further = {"run.duration_s=0.01", "run.image_interval_s=1", "barrier.settle_time_s=0"};
  const std::vector<StudyCase> one = cases_of(selection);
  const JobOptions options{LAHAR_EXECUTABLE, folder.path(), 1, 2};
  const std::filesystem::path place = folder.path() / one.at(0).name();
  std::vector<std::string> told;
  const auto tell = [&](const std::string& line) { told.push_back(line); };
  const auto stop = [&] { return std::filesystem::exists(place / "image_000000.png"); };  // it has begun
  EXPECT_EQ(run_all(one, options, stop, tell).at(0).exit_code, cases::exit_interrupted);
  EXPECT_EQ(standing_of(one[0], place), Standing::begun);
  EXPECT_EQ(run_all(
                one, options, [] { return false; }, tell)
                .at(0)
                .exit_code,
            cases::exit_done);
  EXPECT_EQ(standing_of(one[0], place), Standing::done);
  ASSERT_EQ(told.size(), 4u);
  EXPECT_NE(told[2].find("goes on"), std::string::npos);
  EXPECT_EQ(run_all(
                one, options, [] { return false; }, tell)
                .at(0)
                .exit_code,
            cases::exit_done);
  EXPECT_EQ(told.size(), 4u);
  const CaseResult result = read_case(one[0], place);
  for (const CaseCheck& check : result.checks) EXPECT_NE(check.outcome, Outcome::failed) << check.name;
  EXPECT_GE(result.checks.size(), 5u);
  EXPECT_TRUE(std::isfinite(result.value("e_b_axial"))) << "of the columns of the run";
  EXPECT_GT(result.curves.time_s.size(), 1u);
  EXPECT_EQ(result.curves.columns.size(), shown_columns().size());
  selection.further.push_back("solids.contact_safety=0.25");
  selection.releases = {1.2, 1.85};
  const std::vector<StudyCase> two = cases_of(selection);
  EXPECT_THROW(run_all(
                   two, options, [] { return false; }, tell),
               InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / two[0].name())) << "begun beside one that is refused";
}

/// What is left of other values or programs in the folder is none of this study.
TEST(StudyFolder, CasesThatCannotBeLoadedAreLeftOut) {
  const cases::TestFolder folder;
  Selection selection{.sweeps = {"matched"}, .couplings = {"resolved"}, .releases = {4.1}};
  const StudyCase resolved = cases_of(selection).at(0);
  const auto left = folder / "out" / resolved.name();
  std::filesystem::create_directories(left);
  std::ofstream(left / "scene.resolved.toml") << scene::to_toml(scene::load(resolved.scene_file(), resolved.changes()));
  EXPECT_EQ(run_study("--report --sweep matched --release 4.1 --coupling averaged --set "
                      "coupling.averaging_length_m=0.08 --out '" +
                          (folder / "out").string() + "'",
                      folder / "messages"),
            0)
      << content_of(folder / "messages");
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "report.html"));
}

/// One damaged case costs the others neither their page nor their list.
TEST(StudyFolder, DamagedCasesAreLeftOutAndNamed) {
  const cases::TestFolder folder;
  Selection selection{.sweeps = {"matched"}, .couplings = {"resolved"}, .releases = {4.1}};
  const StudyCase damaged = cases_of(selection).at(0);
  const auto left = folder / "out" / damaged.name();
  std::filesystem::create_directories(left);
  std::ofstream(left / "scene.resolved.toml") << scene::to_toml(scene::load(damaged.scene_file(), damaged.changes()));
  std::ofstream(left / "summary.json") << "{\"simulated_seconds\": 4";
  const std::string asked = " --sweep matched --release 4.1 --out '" + (folder / "out").string() + "'";
  for (const std::string coupling : {"averaged", "resolved"})
    EXPECT_EQ(run_study("--report --coupling " + coupling + asked, folder / "messages"), 0);
  EXPECT_NE(content_of(folder / "messages").find(damaged.name() + " is left out: "), std::string::npos)
      << content_of(folder / "messages");
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "report.html"));
  EXPECT_EQ(run_study("--list" + asked, folder / "messages"), 0) << content_of(folder / "messages");
}

/// A scene with a key that there is no more: neither the page nor the list stops at it.
TEST(StudyFolder, CasesOfAnotherProgramAreLeftOutAndNamed) {
  const cases::TestFolder folder;
  const StudyCase old = cases_of({.sweeps = {"matched"}, .couplings = {"resolved"}, .releases = {4.1}}).at(0);
  const auto left = folder / "out" / old.name();
  std::filesystem::create_directories(left);
  std::ofstream(left / "scene.resolved.toml")
      << scene::to_toml(scene::load(old.scene_file(), old.changes())) << "\n[forgotten]\nkey = 1\n";
  std::ofstream(left / "summary.json") << "{\"simulated_seconds\": 4}";
  const std::string asked = " --sweep matched --release 4.1 --out '" + (folder / "out").string() + "'";
  for (const std::string coupling : {"averaged", "resolved"}) {
    EXPECT_EQ(run_study("--report --coupling " + coupling + asked, folder / "messages"), 0);
    EXPECT_NE(content_of(folder / "messages").find(old.name() + " is left out: "), std::string::npos)
        << content_of(folder / "messages");
  }
  EXPECT_EQ(run_study("--list" + asked, folder / "messages"), 0) << content_of(folder / "messages");
  EXPECT_EQ(run_study("--coupling resolved" + asked, folder / "messages"), 2);
}

/// Time and memory of what is to do, and of nothing else.
TEST(StudyFolder, EstimatesWhatIsToDo) {
  const cases::TestFolder folder;
  const StudyCase done = cases_of({.sweeps = {"matched"}, .couplings = {"averaged"}, .releases = {4.1}}).at(0);
  std::filesystem::create_directories(folder / "out" / done.name());
  std::ofstream(folder / "out" / done.name() / "scene.resolved.toml")
      << scene::to_toml(scene::load(done.scene_file(), done.changes()));
  std::ofstream(folder / "out" / done.name() / "summary.json")
      << R"({"simulated_seconds": 4, "wall_seconds": 1, "checks": []})";
  const std::string asked = "--sweep matched --coupling averaged --release 4.1 --release 1.85 --threads 1 --out '" +
                            (folder / "out").string() + "' ";
  const auto lines = [&](const std::string& option) {
    EXPECT_EQ(run_study(asked + option, folder / "messages", folder / "printed"), 0) << content_of(folder / "messages");
    return content_of(folder / "printed");
  };
  EXPECT_NE(lines("--list").find("matched-L1.85-coarse-averaged-seed1: to do\n"), std::string::npos);
  const std::string estimated = lines("--estimate");
  EXPECT_NE(estimated.find("matched-L1.85-coarse-averaged-seed1: to do, about "), std::string::npos) << estimated;
  EXPECT_NE(estimated.find(" min"), std::string::npos) << estimated;
  EXPECT_NE(estimated.find(" GB\n"), std::string::npos) << estimated;
  EXPECT_NE(estimated.find(done.name() + ": done, by an unknown commit\n"), std::string::npos) << estimated;
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "report.html"));
}

/// Whoever starts the study may ignore the ends of its children.
TEST(Jobs, ARunThatFailsHasFailedWhereChildrenAreIgnored) {
  const cases::TestFolder folder;
  const std::vector<StudyCase> one =
      cases_of({.sweeps = {"as_printed"}, .couplings = {"averaged"}, .releases = {1.85}});
  const JobOptions options{"/bin/false", folder.path(), 1, 1};
  std::signal(SIGCHLD, SIG_IGN);
  const auto results = run_all(
      one, options, [] { return false; }, [](const std::string&) {});
  std::signal(SIGCHLD, SIG_DFL);
  EXPECT_EQ(results.at(0).exit_code, 1);
}

TEST(Jobs, ARunThatFailsIsNamedWithItsLog) {
  const cases::TestFolder folder;
  Selection selection{.sweeps = {"as_printed"}, .couplings = {"averaged"}, .releases = {1.85}};
  selection.further = {"run.duration_s=0.01"};
  const StudyCase one = cases_of(selection).at(0);
  std::filesystem::create_directories(folder / "study" / one.name());
  std::ofstream(folder / "study" / one.name() / "scene.resolved.toml")
      << scene::to_toml(scene::load(one.scene_file(), one.changes()));
  std::ofstream(folder / "study" / one.name() / "checkpoint.h5") << "of a program long ago";
  const std::string study = "'" + (folder / "study").string() + "'";
  EXPECT_EQ(run_study("--sweep as_printed --coupling averaged --release 1.85 --set run.duration_s=0.01 --quiet --out " +
                          study,
                      folder / "messages"),
            2);
  const std::filesystem::path log = log_of(one, folder / "study");
  EXPECT_NE(content_of(folder / "messages").find("ended with exit code 2: " + log.string()), std::string::npos)
      << content_of(folder / "messages");
  EXPECT_NE(content_of(log).find("checkpoint.h5"), std::string::npos) << content_of(log);
}

}  // namespace
}  // namespace lahar::study
