#include "lbm/free_surface/cell_flags.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

using Levels = std::vector<double>;

Levels levels_of(const SurfaceFields<double>& s) { return {s.fill_level, s.fill_level + kBlockCells}; }

/// Rows and single cells are judged alike: with a body that covers nothing a block is judged cell by cell.
TEST(CellFlags, RowsAgreeWithCells) {
  FluidOptions o = tank_options(Vec3(0.6, 0.2, 0.4), 0.02, 3.0);
  Fluid<double> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.2, 0.2, 0.3)}});
  int filled = 0, emptied = 0;
  std::size_t drops = 0;
  for (int s = 0; s < 400; ++s) {
    fluid.step();
    if (s % 8 != 7) continue;
    auto& grid = fluid.grid();
    for (const BlockIndex b : std::vector<BlockIndex>(grid.owned())) {
      if (!grid.has_surface(b)) continue;
      SurfaceFields<double>& surface = *grid.block(b).surface;
      // So that cells of all kinds occur: masses as they may be before a conversion.
      for (int k = 0; k < surface.count; ++k) {
        double& mass = surface.mass[surface.cells[static_cast<std::size_t>(k)]];
        mass += 0.03 * ((7 * k + s) % 5 - 2);
      }
      const Levels before = levels_of(surface);
      Flagged<double> by_rows, by_cells;
      flag_conversions(grid, b, fluid.parity(), 3, 0.3, by_rows);
      const Levels after = levels_of(surface);
      std::copy(before.begin(), before.end(), surface.fill_level);
      grid.require_body(b);
      flag_conversions(grid, b, fluid.parity(), 3, 0.3, by_cells);
      grid.release_body(b);
      ASSERT_EQ(after, levels_of(surface));
      ASSERT_EQ(by_rows.filled, by_cells.filled);
      ASSERT_EQ(by_rows.emptied, by_cells.emptied);
      ASSERT_EQ(by_rows.drops.size(), by_cells.drops.size());
      filled += by_rows.filled.count(), emptied += by_rows.emptied.count(), drops += by_rows.drops.size();
    }
  }
  EXPECT_GT(filled, 0);
  EXPECT_GT(emptied, 0);
  RecordProperty("drops", static_cast<int>(drops));
}

}  // namespace
}  // namespace lahar::lbm
