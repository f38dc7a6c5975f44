#include "lbm/grid/block_topology.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(BlockTopology, ReusesIndicesAndListsThemInOrder) {
  BlockTopology t;
  for (int x = 0; x < 10; ++x) t.insert({x, 0, 0});
  t.erase(3);
  t.erase(7);
  EXPECT_EQ(t.insert({20, 0, 0}), 3);
  EXPECT_EQ(t.insert({21, 0, 0}), 7);
  EXPECT_TRUE(std::is_sorted(t.active().begin(), t.active().end()));
  EXPECT_EQ(t.active().size(), 10U);
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
