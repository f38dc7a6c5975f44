#include "lbm/grid/cell_set.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <vector>

namespace lahar::lbm {
namespace {

TEST(CellSet, HoldsCells) {
  CellSet set;
  EXPECT_TRUE(set.empty());
  for (const int cell : {511, 0, 64, 200}) set.add(cell);
  EXPECT_EQ(set.count(), 4);
  EXPECT_TRUE(set.has(200));
  EXPECT_FALSE(set.has(201));
  EXPECT_EQ(set.rank(200), 2);
  EXPECT_EQ(set.rank(511), 3);
  set.remove(64);
  EXPECT_FALSE(set.has(64));
  EXPECT_EQ(set.count(), 3);
}

TEST(CellMap, KeepsValuesInTheOrderOfTheCells) {
  CellMap<int> map;
  for (const int cell : {300, 5, 511, 64}) map.add(cell, 2 * cell);
  int last = -1;
  map.for_each([&](int cell, int value) {
    EXPECT_EQ(value, 2 * cell);
    EXPECT_GT(cell, last);
    last = cell;
  });
  EXPECT_EQ(last, 511);
  EXPECT_EQ(map.at(300), 600);
  EXPECT_EQ(map.find(301), nullptr);
}

/// Every neighbour of a cell is in one of the blocks around, and the cell faces that block.
TEST(CellSet, FacesTheBlocksOfItsNeighbours) {
  for (int cell = 0; cell < kBlockCells; cell += 5) {
    CellSet set;
    set.add(cell);
    int links = 0;
    for (int slot = 0; slot < 27; ++slot)
      for_each_neighbour_in(cell, slot, [&](int neighbour) {
        EXPECT_TRUE(set.facing(slot).has(cell));
        EXPECT_GE(neighbour, 0);
        ++links;
      });
    EXPECT_EQ(links, D3Q19::q - 1);
  }
  CellSet middle;
  middle.add(cell_index(3, 4, 5));
  for (int slot = 0; slot < 27; ++slot) EXPECT_EQ(middle.facing(slot).empty(), slot != 13);
}

TEST(CellSet, ReachesTheBlocksOfItsNeighbours) {
  for (unsigned seed = 1; seed < 200; ++seed) {
    std::mt19937 random(seed);
    CellSet set;
    const int cell = static_cast<int>(random() % kBlockCells);
    set.add(cell);
    std::uint32_t slots = 1U << 13;
    for (int i = 1; i < D3Q19::q; ++i) slots |= 1U << kNeighbours.slot(i, cell);
    EXPECT_EQ(set.reach() & slots, slots);
    // No more than the sides say: with the corner blocks, which no velocity leads to.
    EXPECT_EQ(std::popcount(set.reach()), std::popcount(slots) == 7 ? 8 : std::popcount(slots));
  }
}

/// The table by sides names each link once, in the order of the velocities.
TEST(CellSet, NeighboursInBlocksAreThoseOfTheLinks) {
  for (int cell = 0; cell < kBlockCells; ++cell)
    for (int slot = 0; slot < 27; ++slot) {
      std::vector<int> expected, found;
      for (int i = 1; i < D3Q19::q; ++i)
        if (static_cast<int>(kNeighbours.slot(i, cell)) == slot) expected.push_back(kNeighbours.cell(i, cell));
      for_each_neighbour_in(cell, slot, [&](int neighbour) { found.push_back(neighbour); });
      ASSERT_EQ(found, expected) << cell << " " << slot;
    }
}

}  // namespace
}  // namespace lahar::lbm
