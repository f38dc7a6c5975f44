#include "cases/files/growing_file.h"

#include <fstream>

#include "cases/files/output_file.h"
#include "tests/cases/files/test_folder.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

TEST(GrowingFile, OthersSeeCopiesAndThenTheFileItself) {
  const TestFolder folder;
  GrowingFile file(folder / "rows.h5");
  EXPECT_EQ(file.open_name(), folder / "rows.h5.open");
  EXPECT_TRUE(file.copy_due());
  write(file.open_name(), "one");
  file.copy();
  EXPECT_FALSE(file.copy_due());
  write(file.open_name(), "one two");
  EXPECT_EQ(scene::file_text(file.name()), "one");
  file.copy();
  EXPECT_EQ(scene::file_text(file.name()), "one two");
  write(file.open_name(), "three");
  file.finish();
  EXPECT_EQ(scene::file_text(file.name()), "three");
  EXPECT_FALSE(std::filesystem::exists(file.open_name()));
}

TEST(GrowingFile, GoesOnFromWhatOthersSee) {
  const TestFolder folder;
  GrowingFile file(folder / "rows.h5");
  EXPECT_THROW(file.take_up(), FileError);
  write(file.name(), "one");
  write(file.open_name(), "left behind by a killed run");
  file.take_up();
  EXPECT_EQ(scene::file_text(file.open_name()), "one");
}

TEST(GrowingFile, WhatNobodyCanReadGetsAnotherName) {
  const TestFolder folder;
  const GrowingFile file(folder / "rows.h5");
  EXPECT_TRUE(file.set_aside().empty());
  write(file.name(), "noise");
  EXPECT_EQ(file.set_aside(), folder / "rows.damaged.h5");
  EXPECT_FALSE(std::filesystem::exists(file.name()));
  EXPECT_EQ(scene::file_text(folder / "rows.damaged.h5"), "noise");
}

TEST(GrowingFile, EachDamagedFileIsKept) {
  const TestFolder folder;
  const GrowingFile file(folder / "rows.h5");
  for (const char* text : {"first", "second", "third"}) write(file.name(), text), (void)file.set_aside();
  EXPECT_EQ(scene::file_text(folder / "rows.damaged.h5"), "first");
  EXPECT_EQ(scene::file_text(folder / "rows.damaged2.h5"), "second");
  EXPECT_EQ(scene::file_text(folder / "rows.damaged3.h5"), "third");
}

/// No room for the copy says nothing of the file: here a folder that holds something is in its place.
TEST(GrowingFile, WhatCannotBeCopiedStaysAsItIs) {
  const TestFolder folder;
  const GrowingFile file(folder / "rows.h5");
  write(file.name(), "whole");
  std::filesystem::create_directories(file.open_name() / "in the way");
  EXPECT_THROW(file.take_up(), CannotTakeUp);
  EXPECT_EQ(scene::file_text(file.name()), "whole");
}

/// What has grown is whole all the same, and the next copy can wait.
TEST(GrowingFile, ACopyThatThereIsNoRoomForIsPutOff) {
  const TestFolder folder;
  GrowingFile file(folder / "rows.h5");
  write(file.open_name(), "grown");
  std::filesystem::create_directories((folder / "rows.h5.part") / "in the way");
  ASSERT_TRUE(file.copy_due());
  EXPECT_THROW(file.copy(), CannotCopy);
  EXPECT_FALSE(file.copy_due());
  file.finish();
  EXPECT_EQ(scene::file_text(file.name()), "grown");
}

TEST(GrowingFile, SaysWhatItCannotWrite) {
  const TestFolder folder;
  GrowingFile file(folder / "nowhere" / "rows.h5");
  EXPECT_THROW(file.copy(), FileError);
  EXPECT_THROW(file.finish(), FileError);
}

}  // namespace
}  // namespace lahar::cases
