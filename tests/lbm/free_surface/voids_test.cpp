#include "lbm/free_surface/voids.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Water, 0.24 m deep, at rest or moving as a whole; voids are put into it next to each other, at a corner of blocks.
class VoidsTest : public testing::Test {
 protected:
  explicit VoidsTest(const Vec3& velocity = Vec3::Zero())
      : fluid_(tank_options(Vec3(0.4, 0.4, 0.4), 0.02, 3.0)), grid_(fluid_.grid()) {
    fluid_.fill({{Vec3::Zero(), Vec3(0.4, 0.4, 0.24), velocity}});
    changes_.fit(grid_);
  }
  CellPlace make_void(const Vec3i& cell, double mass) {
    const CellPlace p{grid_.topology().find(block_of(cell)), cell_index(cell.x() & 7, cell.y() & 7, cell.z() & 7)};
    SurfaceFields<double>& surface = grid_.require_surface(p.block);
    grid_.block(p.block).type[static_cast<std::size_t>(p.cell)] = CellType::interface;
    surface.mass[p.cell] = mass;
    grid_.list_cells(p.block);
    return p;
  }
  void close() {
    Voids<double> voids(grid_, changes_, fluid_.parity(), EquilibriumOrder::fourth);
    for (const BlockIndex b : grid_.owned())
      if (grid_.has_surface(b)) {
        voids.find(b);
        changes_.note_reach(grid_, b, changes_.of(b).claims.cells());
      }
    changes_.list_reached(grid_);
    for (const BlockIndex b : changes_.reached()) voids.pay(b);
    for (const BlockIndex b : changes_.reached()) voids.close(b);
    changes_.clear();
  }
  double mass(CellPlace p) { return grid_.block(p.block).surface->mass[p.cell]; }
  double pressure(CellPlace p) { return outgoing_moments(grid_, p, fluid_.parity()).drho; }

  Fluid<double> fluid_;
  FluidGrid<double>& grid_;
  LevelChanges<double> changes_;
};

TEST_F(VoidsTest, FillFromLiquidUnderPressure) {
  const CellPlace a = make_void({8, 8, 4}, 0.3);
  const double before = fluid_.liquid_mass();
  for (int k = 0; k < 3; ++k) {
    const double had = mass(a);
    close();
    EXPECT_GT(mass(a), had);
  }
  EXPECT_NEAR(fluid_.liquid_mass() / before, 1, 1e-14);
}

/// Each neighbour of several voids gives half of its pressure at most, to all together.
TEST_F(VoidsTest, TakeNoMoreThanHalfOfThePressure) {
  for (const Vec3i& cell : {Vec3i(7, 8, 4), Vec3i(9, 8, 4), Vec3i(8, 7, 4), Vec3i(8, 9, 4)}) make_void(cell, 0.1);
  const CellPlace between{grid_.topology().find({1, 1, 0}), cell_index(0, 0, 4)};
  ASSERT_EQ(grid_.type(between), CellType::liquid);
  const double start = pressure(between), before = fluid_.liquid_mass();
  ASSERT_GT(start, 0);
  close();
  EXPECT_NEAR(pressure(between), start / 2, 1e-14);
  EXPECT_NEAR(fluid_.liquid_mass() / before, 1, 1e-14);
}

class VoidsInAStream : public VoidsTest {
 protected:
  VoidsInAStream() : VoidsTest(Vec3(0.9, -0.4, 0.2)) {}
};

/// What goes into a void takes its momentum along: a cell that pays goes on as it did.
TEST_F(VoidsInAStream, TakeLiquidWithItsMomentum) {
  const CellPlace a = make_void({8, 8, 4}, 0.3), beside = {a.block, a.cell + 1};
  const double start = pressure(beside);
  const CellMoments<double> before = outgoing_moments(grid_, beside, fluid_.parity());
  ASSERT_GT(std::abs(before.u[0]), 0.01);
  close();
  ASSERT_LT(pressure(beside), 0.9 * start);
  const CellMoments<double> after = outgoing_moments(grid_, beside, fluid_.parity());
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(after.u[k], before.u[k], 1e-16 + 1e-14 * std::abs(before.u[k]));
}

}  // namespace
}  // namespace lahar::lbm
