#include "cases/files/output_file.h"

#include <fstream>
#include <sstream>

#include "tests/cases/files/test_folder.h"

namespace lahar::cases {
namespace {

std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(OutputFile, ReplacesTheWholeText) {
  const TestFolder folder;
  replace_text_file(folder / "a.txt", "a long first version");
  replace_text_file(folder / "a.txt", "short");
  EXPECT_EQ(content(folder / "a.txt"), "short");
}

TEST(OutputFile, KeepsTheOldFileWhenWritingFails) {
  const TestFolder folder;
  replace_text_file(folder / "a.txt", "old");
  const auto fails = [](const std::filesystem::path& part) {
    std::ofstream(part) << "half";
    throw FileError(part, "no more");
  };
  EXPECT_THROW(replace_file(folder / "a.txt", fails), FileError);
  EXPECT_EQ(content(folder / "a.txt"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "a temporary file was left";
}

TEST(OutputFile, NamesTheFileThatCannotBeCreated) {
  const TestFolder folder;
  try {
    replace_text_file(folder / "missing/a.txt", "text");
    FAIL() << "no exception";
  } catch (const FileError& error) {
    EXPECT_EQ(error.path(), folder / "missing/a.txt");
    EXPECT_EQ(std::string(error.what()),
              (folder / "missing/a.txt").string() + ": cannot be created: No such file or directory");
  }
}

}  // namespace
}  // namespace lahar::cases
