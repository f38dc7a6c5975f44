#include "lbm/free_surface/refilling.h"

#include <gtest/gtest.h>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Three interface cells with known moments around a cell at a corner of blocks; one of them is new itself.
TEST(Refilling, TakesTheMeanOfNeighboursThatWereWet) {
  Fluid<double> fluid(tank_options(Vec3(0.6, 0.6, 0.6), 0.02, 3.0));
  FluidGrid<double>& grid = fluid.grid();
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z) grid.require_surface(grid.require_block({x, y, z}));
  const auto place = [&](const Vec3i& cell) {
    return CellPlace{grid.topology().find(block_of(cell)), cell_index(cell.x() & 7, cell.y() & 7, cell.z() & 7)};
  };
  const auto put = [&](const Vec3i& cell, const CellMoments<double>& moments) {
    const CellPlace p = place(cell);
    grid.block(p.block).type[static_cast<std::size_t>(p.cell)] = CellType::interface;
    refill_cell(grid, p, fluid.parity(), moments, 0.5, {EquilibriumOrder::fourth});
    return p;
  };
  LevelChanges<double> changes;
  changes.fit(grid);
  put({7, 8, 8}, {0.02, {0.04, 0, 0}});
  put({8, 9, 7}, {0.04, {0, -0.02, 0.01}});
  const CellPlace also_new = put({9, 8, 8}, {0.3, {0.1, 0.1, 0.1}}), opened = place({8, 8, 8});
  changes.of(also_new.block).fresh.add(also_new.cell);
  grid.block(opened.block).type[static_cast<std::size_t>(opened.cell)] = CellType::interface;
  changes.of(opened.block).opened.add(opened.cell);
  refill(grid, changes, opened.block, fluid.parity(), RefillLaw{EquilibriumOrder::fourth});
  const auto m = outgoing_moments(grid, opened, fluid.parity());
  EXPECT_NEAR(m.drho, 0.03, 1e-14);
  EXPECT_NEAR(m.u[0], 0.02, 1e-14);
  EXPECT_NEAR(m.u[1], -0.01, 1e-14);
  EXPECT_NEAR(m.u[2], 0.005, 1e-14);
  EXPECT_EQ(grid.block(opened.block).surface->mass[opened.cell], 0);
}

}  // namespace
}  // namespace lahar::lbm
