#include "lbm/free_surface/cell_flags.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

using Levels = std::vector<double>;

Levels levels_of(const SurfaceFields<double>& s) { return {s.fill_level, s.fill_level + kBlockCells}; }

/// Rows in which a cell lies at an open face are judged cell by cell. Marks one that is no interface cell in every row
/// that has one.
void judge_by_cells(Block<double>& block, bool by_cells) {
  block.at_rim.fill(false);
  for (std::size_t row = 0; by_cells && row < 64; ++row)
    for (std::size_t n = 8 * row; n < 8 * row + 8; ++n)
      if (block.type[n] != CellType::interface) {
        block.at_rim[n] = true;
        break;
      }
}

/// A body that has a share of some cells and moves at different speeds; two of each fifth row are covered.
void put_body(FluidGrid<double>& grid, BlockIndex b) {
  BodyFields<double>& body = grid.require_body(b);
  for (int n = 0; n < kBlockCells; ++n) {
    const double share = 0.25 * (n % 4);
    body.solid_fraction[n] = body.exchange_weight[n] = share;
    body.weighted_velocity_x[n] = share * 0.01 * (n % 5);
  }
  for (std::size_t row = 0; row < body.covered.size(); row += 5) body.covered[row] = 0b00100100;
}

/// Judges the cells of collapsing water and of drops by rows and one by one, with a body or without.
void expect_rows_and_cells_alike(bool with_body) {
  FluidOptions o = tank_options(Vec3(0.6, 0.2, 0.4), 0.02, 3.0);
  Fluid<double> fluid(o);
  std::vector<LiquidRegion> regions{{Vec3::Zero(), Vec3(0.2, 0.2, 0.3)}};
  for (const double z : {0.2, 0.28, 0.36})
    regions.push_back({Vec3(0.4, 0.1, z), Vec3(0.42, 0.12, z + 0.02), Vec3(1, 0, 0)});
  fluid.fill(regions);
  int filled = 0, emptied = 0, owing = 0, drops = 0;
  for (int s = 0; s < 400; ++s) {
    fluid.step();
    if (s % 2 != 1) continue;
    const auto round = static_cast<std::uint64_t>(s);  // of which it hangs whether drops move
    auto& grid = fluid.grid();
    for (const BlockIndex b : std::vector<BlockIndex>(grid.owned())) {
      if (!grid.has_surface(b)) continue;
      Block<double>& block = grid.block(b);
      SurfaceFields<double>& surface = *block.surface;
      if (with_body) put_body(grid, b);
      // So that cells of all kinds occur: masses as they may be before a conversion.
      const Levels masses(surface.mass, surface.mass + kBlockCells), before = levels_of(surface);
      for (int k = 0; k < surface.count; ++k) {
        const int n = surface.cells[static_cast<std::size_t>(k)];
        surface.mass[n] += 0.03 * ((7 * k + s) % 5 - 2) - (k % 23 == 5 ? 0.8 : 0.0);
      }
      const auto rim = block.at_rim;
      Flagged<double> by_rows, by_cells;
      judge_by_cells(block, false);
      flag_conversions(grid, b, fluid.parity(), round, 0.3, by_rows);
      const Levels after = levels_of(surface);
      std::copy(before.begin(), before.end(), surface.fill_level);
      judge_by_cells(block, true);
      flag_conversions(grid, b, fluid.parity(), round, 0.3, by_cells);
      block.at_rim = rim;
      ASSERT_EQ(after, levels_of(surface));
      if (with_body) grid.release_body(b);  // the flow goes on as it was
      std::copy(masses.begin(), masses.end(), surface.mass);
      std::copy(before.begin(), before.end(), surface.fill_level);
      ASSERT_EQ(by_rows.filled, by_cells.filled);
      ASSERT_EQ(by_rows.emptied, by_cells.emptied);
      ASSERT_EQ(by_rows.owing, by_cells.owing);
      ASSERT_EQ(by_rows.drops.size(), by_cells.drops.size());
      filled += by_rows.filled.count(), emptied += by_rows.emptied.count(), owing += by_rows.owing.count();
      drops += static_cast<int>(by_rows.drops.size());
    }
  }
  EXPECT_GT(filled, 0);
  EXPECT_GT(emptied, 0);
  EXPECT_GT(owing, 0);
  EXPECT_GT(drops, 0);
}

TEST(CellFlags, RowsAgreeWithCells) { expect_rows_and_cells_alike(false); }

TEST(CellFlags, RowsAgreeWithCellsAtBodies) { expect_rows_and_cells_alike(true); }

/// A cell may lack or exceed by more where a body moves: by 0.01 and twice its speed, at most 0.11.
TEST(CellFlags, BodiesThatMoveAreGivenMoreRoom) {
  FluidOptions o = tank_options(Vec3(0.16, 0.16, 0.16), 0.02, 3.0);
  Fluid<double> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.16, 0.16, 0.07)}});
  auto& grid = fluid.grid();
  for (const BlockIndex b : std::vector<BlockIndex>(grid.owned())) {
    if (!grid.has_surface(b)) continue;
    SurfaceFields<double>& surface = *grid.block(b).surface;
    BodyFields<double>& body = grid.require_body(b);
    const auto flags = [&](double share, double speed, double liquid) {
      for (int n = 0; n < kBlockCells; ++n) {
        body.solid_fraction[n] = body.exchange_weight[n] = share;
        body.weighted_velocity_y[n] = -share * speed;
      }
      for (int k = 0; k < surface.count; ++k) {
        const int n = surface.cells[static_cast<std::size_t>(k)];
        surface.mass[n] = share + liquid, surface.fill_level[n] = 0.5, surface.density[n] = 0;
      }
      Flagged<double> flagged;
      flag_conversions(grid, b, fluid.parity(), 3, 0.0, flagged);
      return std::pair(flagged.filled.count(), flagged.emptied.count());
    };
    const std::pair none(0, 0), all_empty(0, surface.count), all_full(surface.count, 0);
    EXPECT_EQ(flags(0.5, 0, -0.02), all_empty);
    EXPECT_EQ(flags(0.5, 0.02, -0.02), none);
    EXPECT_EQ(flags(0.5, 0.02, -0.06), all_empty);
    EXPECT_EQ(flags(0.5, 0.2, -0.1), none);
    EXPECT_EQ(flags(0.5, 0.2, -0.12), all_empty);
    EXPECT_EQ(flags(0.5, 0, 0.52), all_full);
    EXPECT_EQ(flags(0.5, 0.02, 0.52), none);
    EXPECT_EQ(flags(0.5, 0.02, 0.56), all_full);
    EXPECT_EQ(flags(0, 0.02, -0.02), all_empty);
    grid.release_body(b);
  }
}

}  // namespace
}  // namespace lahar::lbm
