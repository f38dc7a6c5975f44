#include "lbm/free_surface/drop_moves.h"

#include <gtest/gtest.h>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Single interface cells in gas, on both sides of the border between blocks at x = 8.
class DropMoves : public testing::Test {
 protected:
  DropMoves() : fluid_(tank_options(Vec3(0.6, 0.6, 0.6), 0.02, 3.0)), grid_(fluid_.grid()) {
    for (int x = 0; x < 3; ++x)
      for (int y = 0; y < 3; ++y)
        for (int z = 0; z < 3; ++z) grid_.require_surface(grid_.require_block({x, y, z}));
    changes_.fit(grid_);
  }
  CellPlace place(const Vec3i& cell) {
    return {grid_.topology().find(block_of(cell)), cell_index(cell.x() & 7, cell.y() & 7, cell.z() & 7)};
  }
  void drop(const Vec3i& cell, int direction, double mass) {
    const CellPlace p = place(cell);
    grid_.block(p.block).type[static_cast<std::size_t>(p.cell)] = CellType::interface;
    grid_.block(p.block).surface->mass[p.cell] = mass;
    changes_.of(p.block).flagged.drops.push_back(
        {static_cast<std::uint16_t>(p.cell), static_cast<std::uint8_t>(direction), {}});
  }
  void move() {
    for (const BlockIndex b : grid_.owned()) choose_moving_drops(grid_, changes_, b);
    for (const BlockIndex b : grid_.owned()) move_drops(grid_, changes_, b);
  }
  CellType type(const Vec3i& cell) { return grid_.type(place(cell)); }
  double arrived(const Vec3i& cell) {
    const CellPlace p = place(cell);
    const Arrival<double>* a = changes_.of(p.block).arrivals.find(p.cell);
    return a ? a->liquid : 0;
  }

  Fluid<double> fluid_;
  FluidGrid<double>& grid_;
  LevelChanges<double> changes_;
};

TEST_F(DropMoves, GoToTheNextCell) {
  drop({7, 4, 4}, 1, 0.3);
  move();
  EXPECT_EQ(type({7, 4, 4}), CellType::gas);
  EXPECT_EQ(type({8, 4, 4}), CellType::interface);
  EXPECT_EQ(arrived({8, 4, 4}), 0.3);
}

/// Velocity 1 is before 2, whatever the blocks are called.
TEST_F(DropMoves, TheLowerVelocityGetsACellThatTwoWant) {
  drop({9, 4, 4}, 2, 0.2);
  drop({7, 4, 4}, 1, 0.3);
  move();
  EXPECT_EQ(type({7, 4, 4}), CellType::gas);
  EXPECT_EQ(type({8, 4, 4}), CellType::interface);
  EXPECT_EQ(type({9, 4, 4}), CellType::interface);
  EXPECT_EQ(arrived({8, 4, 4}), 0.3);
}

TEST_F(DropMoves, NeighboursMoveTogether) {
  drop({7, 4, 4}, 1, 0.3);
  drop({7, 5, 4}, 1, 0.2);
  move();
  EXPECT_EQ(arrived({8, 4, 4}), 0.3);
  EXPECT_EQ(arrived({8, 5, 4}), 0.2);
}

}  // namespace
}  // namespace lahar::lbm
