#include "lbm/free_surface/excess_mass.h"

#include <gtest/gtest.h>

#include "lbm/free_surface/refilling.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Interface cells in gas, at corners of blocks; nothing else.
class ExcessMassTest : public testing::Test {
 protected:
  ExcessMassTest() : fluid_(tank_options(Vec3(0.6, 0.6, 0.6), 0.02, 3.0)), grid_(fluid_.grid()) {
    for (int x = 0; x < 3; ++x)
      for (int y = 0; y < 3; ++y)
        for (int z = 0; z < 3; ++z) grid_.require_surface(grid_.require_block({x, y, z}));
    changes_.fit(grid_);
  }
  CellPlace place(const Vec3i& cell) {
    return {grid_.topology().find(block_of(cell)), cell_index(cell.x() & 7, cell.y() & 7, cell.z() & 7)};
  }
  CellPlace put(const Vec3i& cell, CellType type, double mass) {
    const CellPlace p = place(cell);
    grid_.block(p.block).type[static_cast<std::size_t>(p.cell)] = type;
    grid_.block(p.block).surface->mass[p.cell] = mass;
    return p;
  }
  void owe(const Vec3i& cell, double mass) {
    const CellPlace p = place(cell);
    changes_.of(p.block).excess.push_back({p.cell, mass});
    CellSet cells;
    cells.add(p.cell);
    changes_.note_reach(grid_, p.block, cells);
  }
  double mass(CellPlace p) { return grid_.block(p.block).surface->mass[p.cell]; }
  /// Returns what went to the pool.
  double distribute() {
    changes_.list_reached(grid_);
    ExcessMass<double> excess(grid_, changes_, fluid_.parity(), EquilibriumOrder::fourth);
    for (const auto phase : {&ExcessMass<double>::offer, &ExcessMass<double>::pay, &ExcessMass<double>::collect,
                             &ExcessMass<double>::take})
      for (const BlockIndex b : changes_.reached()) (excess.*phase)(b);
    double pooled = 0;
    for (const BlockIndex b : changes_.reached()) pooled += changes_.of(b).pooled;
    return pooled;
  }

  Fluid<double> fluid_;
  FluidGrid<double>& grid_;
  LevelChanges<double> changes_;
};

TEST_F(ExcessMassTest, GoesToNeighboursInEqualParts) {
  const CellPlace a = put({7, 8, 8}, CellType::interface, 0.5), b = put({9, 8, 7}, CellType::interface, 0.1);
  owe({8, 8, 8}, 0.04);
  EXPECT_EQ(distribute(), 0);
  EXPECT_DOUBLE_EQ(mass(a), 0.52);
  EXPECT_DOUBLE_EQ(mass(b), 0.12);
}

TEST_F(ExcessMassTest, DebtsArePaidInProportionToLiquid) {
  const CellPlace a = put({7, 8, 8}, CellType::interface, 0.6), b = put({9, 8, 7}, CellType::interface, 0.2);
  owe({8, 8, 8}, -0.04);
  EXPECT_EQ(distribute(), 0);
  EXPECT_DOUBLE_EQ(mass(a), 0.57);
  EXPECT_DOUBLE_EQ(mass(b), 0.19);
}

TEST_F(ExcessMassTest, WhatNobodyCanPayGoesToThePool) {
  const CellPlace a = put({7, 8, 8}, CellType::interface, 0.01);
  owe({8, 8, 8}, -0.04);
  EXPECT_NEAR(distribute(), -0.03, 1e-15);
  EXPECT_NEAR(mass(a), 0, 1e-15);
}

/// Two cells that owe ask one between them for more than it has: each gets its share, and nobody goes below nothing.
TEST_F(ExcessMassTest, OverlappingDebtsAreScaled) {
  const CellPlace a = put({8, 8, 8}, CellType::interface, 0.03);
  owe({7, 8, 8}, -0.03);
  owe({9, 8, 8}, -0.01);
  EXPECT_NEAR(distribute(), -0.01, 1e-15);
  EXPECT_NEAR(mass(a), 0, 1e-15);
}

/// What is left goes to liquid neighbours, which go on as they did.
TEST_F(ExcessMassTest, LiquidTakesWhatIsLeft) {
  const CellPlace wet = put({7, 7, 8}, CellType::liquid, 0);
  refill_cell(grid_, wet, fluid_.parity(), {0.0, {0.05, -0.02, 0.01}}, 0.0, {EquilibriumOrder::fourth});
  const CellMoments<double> before = outgoing_moments(grid_, wet, fluid_.parity());
  owe({8, 8, 8}, 0.04);
  EXPECT_EQ(distribute(), 0);
  const CellMoments<double> after = outgoing_moments(grid_, wet, fluid_.parity());
  EXPECT_NEAR(after.drho - before.drho, 0.04, 1e-15);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(after.u[k], before.u[k], 1e-15);
}

}  // namespace
}  // namespace lahar::lbm
