// Which blocks are given back: those that hold neither a wet cell nor a neighbour of one.
#include "lbm/step/dry_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

constexpr int kBlocks = 5;  // each way
using Coordinate = std::array<int, 3>;

Coordinate array_of(const Vec3i& v) { return {v.x(), v.y(), v.z()}; }

/// Periodic along all axes, all blocks made, none wet.
struct DryGrid : FluidGrid<double> {
  DryGrid() : FluidGrid(lattice_options(Vec3i::Constant(kBlocks * kBlockWidth), 0.1).domain, 1) {
    std::vector<Vec3i> all;
    for (int x = 0; x < kBlocks; ++x)
      for (int y = 0; y < kBlocks; ++y)
        for (int z = 0; z < kBlocks; ++z) all.emplace_back(x, y, z);
    require_blocks(all);
  }
};

void wet(FluidGrid<double>& grid, const Vec3i& cell) {
  const BlockIndex b = grid.require_block(block_of(cell));
  const Vec3i place = cell - grid.lowest_cell(b);
  grid.block(b).type[static_cast<std::size_t>(cell_index(place.x(), place.y(), place.z()))] = CellType::liquid;
  grid.list_cells(b);
}

/// Coordinates of the blocks that are left.
std::vector<Coordinate> left(const FluidGrid<double>& grid) {
  std::vector<Coordinate> coordinates;
  for (const BlockIndex b : grid.owned()) coordinates.push_back(array_of(grid.topology().coordinate(b)));
  std::sort(coordinates.begin(), coordinates.end());
  return coordinates;
}

/// Of the 27 cells around a cell, itself included.
std::vector<Coordinate> blocks_around(const Vec3i& cell) {
  std::vector<Coordinate> coordinates;
  for (int n = 0; n < 27; ++n) {
    Vec3i block = block_of(cell + Vec3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
    for (int a = 0; a < 3; ++a) block[a] = (block[a] + kBlocks) % kBlocks;
    coordinates.push_back(array_of(block));
  }
  std::sort(coordinates.begin(), coordinates.end());
  coordinates.erase(std::unique(coordinates.begin(), coordinates.end()), coordinates.end());
  return coordinates;
}

/// A single wet cell anywhere in its block holds exactly the blocks of its neighbours, also over periodic faces.
TEST(DryBlocks, ACellHoldsTheBlocksAroundIt) {
  for (const int x : {16, 17, 20, 22, 23})
    for (const auto& [y, z] : {std::pair{16, 1}, {17, 0}, {22, 39}, {23, 38}, {20, 20}}) {
      DryGrid grid;
      wet(grid, Vec3i(x, y, z));
      release_dry_blocks(grid);
      EXPECT_EQ(left(grid), blocks_around(Vec3i(x, y, z))) << x << ' ' << y << ' ' << z;
    }
}

TEST(DryBlocks, AFullBlockHoldsAllAround) {
  DryGrid grid;
  const BlockIndex b = grid.require_block(Vec3i(2, 2, 2));
  grid.block(b).type.fill(CellType::liquid);
  grid.list_cells(b);
  release_dry_blocks(grid);
  EXPECT_EQ(grid.owned().size(), 27U);
  EXPECT_EQ(grid.missing_neighbours(b), 0U);
}

/// What several cells hold is held by each of them.
TEST(DryBlocks, NoCellTakesABlockFromAnother) {
  DryGrid grid;
  const std::array<Vec3i, 4> cells{Vec3i(16, 20, 20), Vec3i(20, 16, 20), Vec3i(31, 8, 3), Vec3i(20, 20, 23)};
  for (const Vec3i& cell : cells) wet(grid, cell);
  release_dry_blocks(grid);
  const std::vector<Coordinate> kept = left(grid);
  for (const Vec3i& cell : cells)
    for (const Coordinate& c : blocks_around(cell)) EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), c));
  EXPECT_LT(kept.size(), static_cast<std::size_t>(kBlocks * kBlocks * kBlocks));
}

/// The last cells of a block may dry in the step in which they gave to a body: it has not been gathered yet.
TEST(DryBlocks, WhatBodiesGotStaysUntilItIsGathered) {
  DryGrid grid;
  const BlockIndex b = grid.require_block(Vec3i(2, 2, 2));
  BodyFields<double>& body = grid.require_body(b);
  body.coverage_weight[100] = 0.5;
  release_dry_blocks(grid);
  ASSERT_EQ(grid.owned().size(), 1U);
  clear_momentum_exchange(body);
  release_dry_blocks(grid);
  EXPECT_TRUE(grid.owned().empty());
}

TEST(DryBlocks, NothingIsLeftOfADryGrid) {
  DryGrid grid;
  release_dry_blocks(grid);
  EXPECT_TRUE(grid.owned().empty());
}

}  // namespace
}  // namespace lahar::lbm
