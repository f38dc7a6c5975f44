#include "lbm/grid/block_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lbm/grid/morton.h"

namespace lahar::lbm {
namespace {

TEST(BlockTopology, FindsWhatWasInserted) {
  BlockTopology t;
  const BlockIndex a = t.insert({0, 0, 0}), b = t.insert({-3, 100, 7});
  EXPECT_EQ(t.find({0, 0, 0}), a);
  EXPECT_EQ(t.find({-3, 100, 7}), b);
  EXPECT_EQ(t.find({1, 0, 0}), kNoBlock);
  EXPECT_EQ(t.coordinate(b), Vec3i(-3, 100, 7));
  EXPECT_THROW(t.insert({0, 0, 0}), std::logic_error);
}

TEST(BlockTopology, LinksNeighboursBothWays) {
  BlockTopology t;
  const BlockIndex a = t.insert({0, 0, 0}), b = t.insert({1, -1, 0});
  EXPECT_EQ(t.neighbours(a)[static_cast<std::size_t>(neighbour_slot(1, -1, 0))], b);
  EXPECT_EQ(t.neighbours(b)[static_cast<std::size_t>(neighbour_slot(-1, 1, 0))], a);
  EXPECT_EQ(t.neighbours(a)[13], a);
  t.erase(b);
  EXPECT_EQ(t.neighbours(a)[static_cast<std::size_t>(neighbour_slot(1, -1, 0))], kNoBlock);
  EXPECT_EQ(t.find({1, -1, 0}), kNoBlock);
}

TEST(BlockTopology, ReusesIndices) {
  BlockTopology t;
  for (int x = 0; x < 10; ++x) t.insert({x, 0, 0});
  t.erase(3);
  t.erase(7);
  EXPECT_EQ(t.insert({20, 0, 0}), 3);
  EXPECT_EQ(t.insert({21, 0, 0}), 7);
  EXPECT_EQ(t.active().size(), 10U);
}

std::vector<Vec3i> coordinates(const BlockTopology& t) {
  std::vector<Vec3i> all;
  for (const BlockIndex b : t.active()) all.push_back(t.coordinate(b));
  return all;
}

/// Whatever was made and erased before: one by one, at once, over old indices.
TEST(BlockTopology, ListsBlocksInMortonOrder) {
  const std::vector<Vec3i> blocks{{5, -2, 3}, {0, 0, 0}, {-1, 7, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, -2, 2}};
  BlockTopology one_by_one, at_once, again;
  for (const Vec3i& b : blocks) one_by_one.insert(b);
  EXPECT_EQ(at_once.insert_missing(blocks).size(), blocks.size());
  for (int k = 0; k < 9; ++k) again.insert({k, 9, 9});
  for (BlockIndex b = 8; b >= 0; --b) again.erase(b);
  again.insert(blocks[3]);
  again.insert(blocks[0]);
  EXPECT_EQ(again.insert_missing(blocks).size(), blocks.size() - 2);
  EXPECT_TRUE(again.insert_missing(blocks).empty());
  const auto order = coordinates(one_by_one);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end(),
                             [](const Vec3i& a, const Vec3i& b) { return morton_key(a) < morton_key(b); }));
  EXPECT_EQ(order, coordinates(at_once));
  EXPECT_EQ(order, coordinates(again));
}

TEST(BlockTopology, PeriodicAxisWraps) {
  BlockTopology t({2, 0, 0});
  const BlockIndex a = t.insert({0, 0, 0}), b = t.insert({1, 0, 0});
  EXPECT_EQ(t.find({2, 0, 0}), a);
  EXPECT_EQ(t.find({-1, 0, 0}), b);
  EXPECT_EQ(t.neighbours(a)[static_cast<std::size_t>(neighbour_slot(-1, 0, 0))], b);
  EXPECT_EQ(t.neighbours(a)[static_cast<std::size_t>(neighbour_slot(1, 0, 0))], b);
}

}  // namespace
}  // namespace lahar::lbm
