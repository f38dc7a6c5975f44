#include "cases/files/checkpoint_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/cases/files/test_folder.h"

namespace lahar::cases {
namespace {

struct State {
  std::vector<double> numbers{1, 2, 3, 0.1};
  std::vector<float> none;
  std::uint64_t count = ~std::uint64_t{0};
  std::string text = "a scene";
  std::vector<std::vector<float>> blocks = std::vector<std::vector<float>>(5000, std::vector<float>(512, 0.5F));

  void transfer(Archive& archive) {
    archive.list("numbers", numbers);
    archive.list("none", none);
    archive.value("count", count);
    archive.text("text", text);
    archive.pieces<float>("blocks", blocks.size(), 512, [&](std::size_t k, float* buffer) {
      if (archive.loading())
        blocks[k].assign(buffer, buffer + 512);
      else
        std::copy(blocks[k].begin(), blocks[k].end(), buffer);
    });
  }
};

class CheckpointFile : public testing::Test {
 protected:
  void save(State& state) {
    CheckpointWriter archive(path_);
    archive.part("state", state);
    archive.file().close();
  }
  void load(State& state) {
    CheckpointReader archive(path_);
    archive.part("state", state);
  }
  TestFolder folder_;
  std::filesystem::path path_ = folder_ / "checkpoint.h5";
};

TEST_F(CheckpointFile, WhatComesBackIsWhatWentIn) {
  State state, back;
  state.blocks[4321][17] = -1.25F;
  save(state);
  back.numbers.clear(), back.text.clear(), back.count = 0;
  load(back);
  EXPECT_EQ(back.numbers, state.numbers);
  EXPECT_TRUE(back.none.empty());
  EXPECT_EQ(back.count, state.count);
  EXPECT_EQ(back.text, "a scene");
  EXPECT_EQ(back.blocks, state.blocks);
}

/// Any byte of the numbers that has changed is found before the owner gets them.
TEST_F(CheckpointFile, DamagedNumbersAreFound) {
  State state;
  save(state);
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(std::filesystem::file_size(path_) / 2));  // in the blocks
  file.put('\x7e');
  file.close();
  State back;
  back.blocks[0][0] = 7;
  EXPECT_THROW(load(back), ArchiveError);
  EXPECT_EQ(back.blocks[0][0], 7);
}

TEST_F(CheckpointFile, ATruncatedFileIsRefused) {
  State state, back;
  save(state);
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  EXPECT_THROW(load(back), FileError);
}

TEST_F(CheckpointFile, ListsThatAreMissingOrOfAnotherKindAreRefused) {
  State state;
  save(state);
  CheckpointReader archive(path_);
  float number = 0;
  std::vector<float> numbers;
  EXPECT_THROW(archive.value("state/number", number), FileError);
  EXPECT_THROW(archive.list("state/numbers", numbers), FileError);
}

}  // namespace
}  // namespace lahar::cases
