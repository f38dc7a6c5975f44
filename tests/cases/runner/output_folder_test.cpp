#include "cases/runner/output_folder.h"

#include <gtest/gtest.h>

#include <functional>

#include "cases/scene/writer.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

namespace fs = std::filesystem;

std::size_t count(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

TEST(OutputFolder, IsMadeWithItsParents) {
  const scene::ScratchFolder scratch;
  prepare_output(scratch.path() / "a/b", false);
  EXPECT_TRUE(fs::is_directory(scratch.path() / "a/b"));
  prepare_output(scratch.path() / "a/b", false);  // empty: may be used
  EXPECT_EQ(count(scratch.path() / "a/b"), 0u);
}

TEST(OutputFolder, ForeignFilesAreNeverTouched) {
  const scene::ScratchFolder scratch;
  scratch.write("thesis.txt", "years of work");
  scratch.write("summary.json", "mine");
  EXPECT_THROW(prepare_output(scratch.path(), false), InputError);
  EXPECT_THROW(prepare_output(scratch.path(), true), InputError);
  EXPECT_EQ(count(scratch.path()), 2u);
}

TEST(OutputFolder, AFormerRunIsReplacedOnlyOnDemand) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", std::string(scene::resolved_mark) + "\n");
  for (const char* name : {"summary.json", "run.log", "fluid_000010.vdb", "image_000001.png", "forces_000001.png",
                           "particles.h5", "notes.txt"})
    scratch.write(name, "old");
  EXPECT_THROW(prepare_output(scratch.path(), false), InputError);
  EXPECT_EQ(count(scratch.path()), 8u);
  prepare_output(scratch.path(), true);
  EXPECT_EQ(count(scratch.path()), 1u);
  EXPECT_TRUE(fs::exists(scratch.path() / "notes.txt"));
}

TEST(OutputFolder, AUsersResolvedSceneIsNoRun) {
  const scene::ScratchFolder scratch;
  scratch.write("scene.resolved.toml", "[scene]\n");
  EXPECT_FALSE(holds_run(scratch.path()));
  EXPECT_THROW(prepare_output(scratch.path(), true), InputError);
}

TEST(OutputFolder, AFileInTheWay) {
  const scene::ScratchFolder scratch;
  const fs::path file = scratch.write("file", "x");
  EXPECT_THROW(prepare_output(file, true), InputError);
  EXPECT_THROW(prepare_output(file / "below", true), InputError);
  EXPECT_EQ(scene::file_text(file), "x");
}

std::string refused(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
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

}  // namespace
}  // namespace lahar::cases
