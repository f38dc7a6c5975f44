#include "cases/runner/output_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <vector>

#include "cases/scene/writer.h"
#include "tests/cases/files/small_disk.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

namespace fs = std::filesystem;

std::size_t count(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

std::string refused(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(OutputFolder, IsMadeWithItsParents) {
  const scene::ScratchFolder scratch;
  (void)prepare_output(scratch.path() / "a/b", false);
  EXPECT_TRUE(fs::is_directory(scratch.path() / "a/b"));
  (void)prepare_output(scratch.path() / "a/b", false);  // empty: may be used
  EXPECT_EQ(count(scratch.path() / "a/b"), 0u);
}

TEST(OutputFolder, ForeignFilesAreNeverTouched) {
  const scene::ScratchFolder scratch;
  scratch.write("thesis.txt", "years of work");
  scratch.write("summary.json", "mine");
  EXPECT_THROW((void)prepare_output(scratch.path(), false), InputError);
  EXPECT_THROW((void)prepare_output(scratch.path(), true), InputError);
  EXPECT_EQ(count(scratch.path()), 2u);
}

TEST(OutputFolder, AFormerRunIsReplacedOnlyOnDemand) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", std::string(scene::resolved_mark) + "\n");
  for (const char* name : {"summary.json", "run.log", "fluid_000010.vdb", "image_000001.png", "forces_000001.png",
                           "particles.h5", "notes.txt"})
    scratch.write(name, "old");
  EXPECT_THROW((void)prepare_output(scratch.path(), false), InputError);
  EXPECT_EQ(count(scratch.path()), 8u);
  prepare_output(scratch.path(), true).former.remove();
  EXPECT_EQ(count(scratch.path()), 1u);
  EXPECT_TRUE(fs::exists(scratch.path() / "notes.txt"));
}

/// What a run that was killed or resumed leaves behind goes with it.
TEST(OutputFolder, HalfWrittenAndDamagedFilesGoWithTheirRun) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", std::string(scene::resolved_mark) + "\n");
  for (const char* name : {"series.damaged.h5", "series.damaged2.h5", "particles.damaged17.h5", "checkpoint.h5.part",
                           "fluid_000010.vdb.part", "series.h5.open.part"})
    scratch.write(name, "old");
  for (const char* name : {"series.damagedx.h5", "thesis.part", ".part"}) scratch.write(name, "mine");
  prepare_output(scratch.path(), true).former.remove();
  EXPECT_EQ(count(scratch.path()), 3u);
}

/// A run that ended before its first step has nothing that could be lost.
TEST(OutputFolder, ARunThatDidNotBeginIsReplaced) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", std::string(scene::resolved_mark) + "\n");
  scratch.write("run.log", "old");
  scratch.write("notes.txt", "mine");
  prepare_output(scratch.path(), false).former.remove();
  EXPECT_EQ(count(scratch.path()), 1u);
  EXPECT_TRUE(fs::exists(scratch.path() / "notes.txt"));
}

/// One that was stopped while it wrote its first file; not where there is anything else.
TEST(OutputFolder, AHalfWrittenFirstFileIsNoRun) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml.part", "[sce");
  (void)prepare_output(scratch.path(), false);
  EXPECT_EQ(count(scratch.path()), 0u);
  scratch.write("scene.resolved.toml.part", "[sce");
  scratch.write("notes.txt", "mine");
  EXPECT_THROW((void)prepare_output(scratch.path(), true), InputError);
  EXPECT_EQ(count(scratch.path()), 2u);
}

/// Whatever became of its results.
TEST(OutputFolder, ARunThatBeganIsNotReplacedUnasked) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", std::string(scene::resolved_mark) + "\n");
  const std::string log = fmt::format("info: Lahar\ninfo: {}\ninfo: done at t = 1 s\n", kStepsBeginMark);
  scratch.write("run.log", log);
  EXPECT_NE(refused([&] { (void)prepare_output(scratch.path(), false); }).find("holds a former run"),
            std::string::npos);
  EXPECT_EQ(scene::file_text(scratch.path() / "run.log"), log);
}

/// As when its grains turn out not to fit: what was there before is there again.
TEST(OutputFolder, AFormerRunComesBackIfTheNewOneDoesNotBegin) {
  const scene::ScratchFolder scratch;
  const std::string resolved = std::string(scene::resolved_mark) + "\n";
  scratch.write("scene.resolved.toml", resolved);
  scratch.write("series.h5", "old");
  scratch.write("notes.txt", "mine");
  {
    const PreparedFolder prepared = prepare_output(scratch.path(), true);
    EXPECT_FALSE(fs::exists(scratch.path() / "series.h5"));
    scratch.write("scene.resolved.toml", resolved + "new");
    scratch.write("run.log", "new");
  }
  EXPECT_EQ(count(scratch.path()), 3u);
  EXPECT_EQ(scene::file_text(scratch.path() / "scene.resolved.toml"), resolved);
  EXPECT_EQ(scene::file_text(scratch.path() / "series.h5"), "old");
}

TEST(OutputFolder, AFormerRunComesBackAfterAKillBeforeTheNewOneBegan) {
  const scene::ScratchFolder scratch;
  const std::string resolved = std::string(scene::resolved_mark) + "\n";
  scratch.write("scene.resolved.toml", resolved);
  scratch.write("checkpoint.h5", "old");
  const pid_t child = fork();
  if (child == 0) {
    const PreparedFolder prepared = prepare_output(scratch.path(), true);
    scratch.write("scene.resolved.toml", resolved + "new");
    _exit(0);  // nothing is put back
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_FALSE(fs::exists(scratch.path() / "checkpoint.h5"));
  FormerRun::recover(scratch.path());
  EXPECT_EQ(scene::file_text(scratch.path() / "checkpoint.h5"), "old");
  EXPECT_EQ(scene::file_text(scratch.path() / "scene.resolved.toml"), resolved);
  EXPECT_EQ(count(scratch.path()), 2u);
}

/// Files that were on their way aside, or back, when the process was killed; and those of a run that was being removed.
TEST(OutputFolder, AKillAmidMovingLosesNothing) {
  const scene::ScratchFolder scratch;
  const std::string resolved = std::string(scene::resolved_mark) + "\n";
  scratch.write("scene.resolved.toml", resolved);
  scratch.write("checkpoint.h5", "old");
  for (const char* aside : {".former_run.part", ".former_run.gone"}) fs::create_directory(scratch.path() / aside);
  scratch.write(".former_run.part/series.h5", "old");
  scratch.write(".former_run.gone/run.log", "older");
  FormerRun::recover(scratch.path());
  EXPECT_EQ(scene::file_text(scratch.path() / "scene.resolved.toml"), resolved);
  EXPECT_EQ(scene::file_text(scratch.path() / "checkpoint.h5"), "old");
  EXPECT_EQ(scene::file_text(scratch.path() / "series.h5"), "old");
  EXPECT_EQ(count(scratch.path()), 3u);
}

/// Charts of procedures belong to their runs, and do not stand beside the results of another one.
TEST(OutputFolder, ChartsOfAFormerProcedureGoWithIt) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", std::string(scene::resolved_mark) + "\n");
  for (const char* name : {"rockfall_energy.png", "rockfall_displacement.svg", "ring_pull.pdf",
                           "ring_pull_first_stage.png", "energy_dissipator.svg", "cable_forces.pdf"})
    scratch.write(name, "old");
  for (const char* name : {"rockfall_energy.txt", "rockfall_mine.png"}) scratch.write(name, "mine");
  prepare_output(scratch.path(), true).former.remove();
  EXPECT_EQ(count(scratch.path()), 2u);
}

/// What a user has made of a run's files, and named like them, is no part of the run.
TEST(OutputFolder, NamesThatRunsDoNotWriteStay) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", std::string(scene::resolved_mark) + "\n");
  const std::vector<const char*> mine{"image_best.png",       "fluid_mine.vdb",   "forces_paper.png",
                                      "image_000001_cut.png", "report.html",      "image_1.png",
                                      "fluid_-00001.vdb",     "image_000001.PNG", "fluid_000001.vdb.gz"};
  for (const char* name : mine) scratch.write(name, "mine");
  scratch.write("fluid_1234567.vdb", "old");
  prepare_output(scratch.path(), true).former.remove();
  for (const char* name : mine) EXPECT_TRUE(fs::exists(scratch.path() / name)) << name;
  EXPECT_EQ(count(scratch.path()), mine.size());
}

TEST(OutputFolder, NumbersOfFiles) {
  EXPECT_EQ(number_of_file("fluid_000012.vdb", "fluid_", ".vdb"), 12);
  EXPECT_EQ(number_of_file("fluid_1000000.vdb", "fluid_", ".vdb"), 1000000);
  for (const char* name : {"fluid_.vdb", "fluid_12.vdb", "fluid_0000012.vdb", "fluid_00001x.vdb", "image_000012.png"})
    EXPECT_FALSE(number_of_file(name, "fluid_", ".vdb")) << name;
}

TEST(OutputFolder, AUsersResolvedSceneIsNoRun) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", "[scene]\n");
  EXPECT_FALSE(holds_run(scratch.path()));
  EXPECT_THROW((void)prepare_output(scratch.path(), true), InputError);
}

TEST(OutputFolder, AFileInTheWay) {
  const scene::ScratchFolder scratch;
  const fs::path file = scratch.write("file", "x");
  EXPECT_THROW((void)prepare_output(file, true), InputError);
  EXPECT_THROW((void)prepare_output(file / "below", true), InputError);
  EXPECT_EQ(scene::file_text(file), "x");
}

/// As a user other than root, who may read everything.
TEST(OutputFolder, AFolderThatCannotBeReadIsRefused) {
  const scene::ScratchFolder scratch;
  const fs::path folder = scratch.path() / "post box";
  fs::create_directory(folder);
  fs::permissions(folder, fs::perms(0333));
  const int status = status_of_child([&] {
    constexpr uid_t nobody = 65534;
    if (chdir(folder.c_str()) != 0 || (getuid() == 0 && setuid(nobody) != 0)) _exit(2);
    const std::string why = refused([] { (void)prepare_output(".", true); });
    _exit(why.starts_with("--out .:1:1: cannot be made ready (") ? 0 : 1);
  });
  fs::permissions(folder, fs::perms(0755));
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

/// Here by a file where a folder should be for the former run.
TEST(OutputFolder, AFormerRunThatCannotBeMovedIsRefused) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", std::string(scene::resolved_mark) + "\n");
  scratch.write("series.h5", "old");
  scratch.write(".former_run.part", "mine");
  const std::string why = refused([&] { (void)prepare_output(scratch.path(), true); });
  EXPECT_NE(why.find(":1:1: cannot be made ready (" + (scratch.path() / ".former_run.part").string()),
            std::string::npos)
      << why;
  EXPECT_EQ(count(scratch.path()), 3u);
}

TEST(OutputFolder, ARunThatIsGoingOnKeepsItsFiles) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", std::string(scene::resolved_mark) + "\n");
  {
    const FolderLock lock(scratch.path());
    EXPECT_EQ(
        refused([&] { (void)prepare_output(scratch.path(), true); }),
        scratch.path().string() + ":1:1: a run is going on there, expected another folder, or the end of that run");
    EXPECT_EQ(count(scratch.path()), 1u);
  }
  prepare_output(scratch.path(), true).former.remove();
  EXPECT_EQ(count(scratch.path()), 0u);
}

TEST(OutputFolder, ALockEndsWithItsProcess) {
  const scene::ScratchFolder scratch;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(scratch.path());
    if (write(ready[1], "x", 1) != 1) _exit(1);
    for (;;) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_THROW(FolderLock{scratch.path()}, InputError);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(FolderLock{scratch.path()});
  close(ready[0]), close(ready[1]);
}

TEST(OutputFolder, APlaceThatCannotBeMadeIsRefusedByTheNameOfItsOption) {
  const scene::ScratchFolder scratch;
  create_folder(scratch.path() / "a/b");
  create_folder(scratch.path() / "a/b");
  EXPECT_TRUE(fs::is_directory(scratch.path() / "a/b"));
  EXPECT_NE(refused([] { create_folder("/proc/nothing"); }).find("--out /proc/nothing:1:1: cannot be created"),
            std::string::npos);
  const fs::path file = scratch.write("file", "x");
  EXPECT_NE(refused([&] { create_folder(file, "--records"); }).find("--records " + file.string() + ":1:1: is a file"),
            std::string::npos);
  EXPECT_EQ(scene::file_text(file), "x");
}

TEST(OutputFolder, AFileThatCannotBeWrittenIsRefusedBeforeTheWork) {
  const scene::ScratchFolder scratch;
  const fs::path file = scratch.write("results.json", "of yesterday");
  EXPECT_EQ(refused([&] { require_writable(file, "--json"); }), "");
  EXPECT_EQ(refused([&] { require_writable(scratch.path() / "new.json", "--json"); }), "");
  EXPECT_EQ(scene::file_text(file), "of yesterday");
  EXPECT_EQ(count(scratch.path()), 1u);
  EXPECT_NE(refused([&] { require_writable(scratch.path(), "--json"); }).find("is a folder"), std::string::npos);
  EXPECT_NE(refused([&] {
              require_writable(scratch.path() / "not/there.json", "--json");
            }).find("there.json:1:1: cannot be created (No such file or directory)"),
            std::string::npos);
}

TEST(OutputFolder, ARecordReplacesOnlyARecord) {
  const scene::ScratchFolder scratch;
  const fs::path file = scratch.write("results.json", "");
  const auto require = [&] {
    require_record(file, "--json", "us", [](const std::string& text) { return text == "ours"; });
  };
  EXPECT_EQ(refused(require), "");
  scratch.write("results.json", "ours");
  EXPECT_EQ(refused(require), "");
  scratch.write("results.json", "precious = 1");
  EXPECT_NE(refused(require).find("results.json:1:1: is there and was not written by us"), std::string::npos);
  EXPECT_EQ(scene::file_text(file), "precious = 1");
  fs::remove(file);
  EXPECT_EQ(refused(require), "");
}

TEST(OutputFolder, OnlyRunsAndEmptyFoldersMayBeRemoved) {
  const scene::ScratchFolder scratch;
  const fs::path place = scratch.path() / "kept";
  const auto require = [&] { require_run_or_nothing(place); };
  EXPECT_EQ(refused(require), "");
  fs::create_directory(place);
  EXPECT_EQ(refused(require), "");
  scratch.write("kept/thesis.txt", "years of work");
  EXPECT_NE(refused(require).find("kept:1:1: is there and holds no run"), std::string::npos);
  scratch.write("kept/scene.resolved.toml", std::string(scene::resolved_mark) + "\n");
  EXPECT_EQ(refused(require), "");
  fs::remove_all(place);
  scratch.write("kept", "a file");
  EXPECT_NE(refused(require), "");
}

}  // namespace
}  // namespace lahar::cases
