#include "coupling/pairs_by_block.h"

#include <gtest/gtest.h>

#include <atomic>

namespace lahar::coupling {
namespace {

struct Pair {
  int block;
};

TEST(PairsByBlock, KeepsTheOrderWithinABlock) {
  PairsByBlock by_block;
  EXPECT_EQ(by_block.blocks(), 0U);
  by_block.sort(std::vector<Pair>{{2}, {0}, {2}, {3}, {0}, {2}}, 5);
  const auto in = [&](std::size_t b) {
    const auto pairs = by_block.in(b);
    return std::vector<std::uint32_t>(pairs.begin(), pairs.end());
  };
  EXPECT_EQ(in(0), (std::vector<std::uint32_t>{1, 4}));
  EXPECT_EQ(in(2), (std::vector<std::uint32_t>{0, 2, 5}));
  EXPECT_EQ(in(3), (std::vector<std::uint32_t>{3}));
  EXPECT_FALSE(by_block.any_in(1));
  EXPECT_TRUE(by_block.any_in(3));
  std::atomic<int> blocks = 0, pairs = 0;
  by_block.for_each_block([&](std::size_t b) { ++blocks, pairs += static_cast<int>(by_block.in(b).size()); });
  EXPECT_EQ(blocks, 3);
  EXPECT_EQ(pairs, 6);
}

TEST(PairsByBlock, ComparesWithTheFormerSort) {
  PairsByBlock by_block;
  by_block.sort(std::vector<Pair>{{0}, {2}, {2}}, 3);
  EXPECT_FALSE(by_block.as_many_as_before(2));
  by_block.sort(std::vector<Pair>{{2}, {2}, {4}}, 5);  // there are more blocks now
  EXPECT_TRUE(by_block.as_many_as_before(2));
  EXPECT_TRUE(by_block.as_many_as_before(1));
  EXPECT_FALSE(by_block.as_many_as_before(0));
  EXPECT_FALSE(by_block.as_many_as_before(4));
}

}  // namespace
}  // namespace lahar::coupling
