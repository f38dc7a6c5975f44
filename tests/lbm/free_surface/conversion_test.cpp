#include "lbm/free_surface/conversion.h"

#include <gtest/gtest.h>

#include "lbm/free_surface/refilling.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// After any number of steps the layer between liquid and gas is closed.
TEST(CellConversion, LiquidNeverTouchesGas) {
  FluidOptions o = tank_options(Vec3(0.4, 0.16, 0.4), 0.02, 3.0, 0.1);
  o.smagorinsky = 0.1;
  Fluid<double> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.15, 0.16, 0.3)}});
  for (int s = 0; s < 600; ++s) {
    fluid.step();
    if (s % 50 != 0) continue;
    const auto& grid = fluid.grid();
    for (const BlockIndex b : grid.owned())
      for (int n = 0; n < kBlockCells; ++n) {
        if (grid.type({b, n}) != CellType::liquid) continue;
        for (int i = 1; i < D3Q19::q; ++i) {
          const CellType t = grid.type(grid.neighbour({b, n}, i));
          ASSERT_TRUE(t != CellType::gas && t != CellType::sink) << "step " << s;
        }
      }
  }
}

/// Interface lists and counts agree with the types.
TEST(CellConversion, ListsAgreeWithTypes) {
  Fluid<float> fluid(tank_options(Vec3(0.4, 0.16, 0.4), 0.02, 3.0, 0.1));
  fluid.fill({{Vec3::Zero(), Vec3(0.15, 0.16, 0.3)}});
  for (int s = 0; s < 300; ++s) fluid.step();
  for (const BlockIndex b : fluid.grid().owned()) {
    const auto& block = fluid.grid().block(b);
    int wet = 0, interfaces = 0;
    for (const CellType t : block.type) {
      wet += is_wet(t);
      interfaces += t == CellType::interface;
    }
    EXPECT_EQ(block.wet_cells, wet);
    EXPECT_EQ(block.surface ? block.surface->count : 0, interfaces);
  }
}

/// A cell that owes liquid beside one that is to fill: one that owes little waits for another step, one that owes much
/// empties, and its neighbours pay (docs/decisions/0093).
TEST(CellConversion, DebtsDoNotWaitForCellsThatFill) {
  for (const double debt : {0.1, 0.6}) {
    Fluid<double> fluid(tank_options(Vec3(0.32, 0.32, 0.4), 0.02, 3.0, 0.1));
    fluid.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.21)}});
    FluidGrid<double>& grid = fluid.grid();
    const auto place = [&](const Vec3i& cell) {
      return CellPlace{grid.topology().find(block_of(cell)), cell_index(cell.x() & 7, cell.y() & 7, cell.z() & 7)};
    };
    // The one that owes and the one that fills lie in two blocks.
    const CellPlace owing = place(Vec3i(8, 9, 11)), filling = place(Vec3i(7, 9, 11));
    ASSERT_EQ(grid.type(owing), CellType::interface);
    ASSERT_EQ(grid.type(filling), CellType::interface);
    grid.block(owing.block).surface->mass[owing.cell] = -debt;
    grid.block(filling.block).surface->mass[filling.cell] = 1.3;
    const double before = fluid.liquid_mass();
    fluid.step();
    EXPECT_EQ(grid.type(owing), debt > 0.2 ? CellType::gas : CellType::interface) << debt;
    EXPECT_EQ(grid.type(filling), debt > 0.2 ? CellType::interface : CellType::liquid) << debt;
    EXPECT_NEAR(fluid.liquid_mass() / before, 1, 1e-13);
  }
}

/// A cell half full of a body, which covers it, on a level surface in the air: it empties, and all cells of the surface
/// in its block get its liquid alike, those beside it no more than others (docs/decisions/0113).
TEST(CellConversion, LiquidOfCoveredCellsGoesToThoseNearBy) {
  Fluid<double> fluid(tank_options(Vec3(0.32, 0.32, 0.4), 0.02, 3.0, 0.1));
  fluid.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.21)}});
  FluidGrid<double>& grid = fluid.grid();
  const CellPlace place{grid.topology().find({1, 1, 1}), cell_index(3, 3, 4)};
  Block<double>& block = grid.block(place.block);
  ASSERT_EQ(block.surface->count, 64);
  std::vector<double> before;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) before.push_back(block.surface->mass[cell_index(x, y, 3)]);
  BodyFields<double>& body = grid.require_body(place.block);
  body.solid_fraction[place.cell] = 0.5;
  body.covered[static_cast<std::size_t>(place.cell / 8)] = 1 << place.cell % 8;
  block.type[static_cast<std::size_t>(place.cell)] = CellType::interface;
  refill_cell(grid, place, fluid.parity(), {}, 0.2, {EquilibriumOrder::fourth});
  grid.list_cells(place.block);
  fluid.step();
  EXPECT_EQ(grid.type(place), CellType::gas);
  EXPECT_NEAR(fluid.account().paid_nearby, 0.2, 1e-3);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const double gained = block.surface->mass[cell_index(x, y, 3)] - before[static_cast<std::size_t>(x + 8 * y)];
      EXPECT_NEAR(gained, 0.2 / 64, 1e-3) << x << " " << y;
    }
}

/// A single cell of liquid in the air has no neighbour to give its mass to: nothing is lost.
TEST(CellConversion, LonelyDropKeepsItsMass) {
  FluidOptions o = tank_options(Vec3(0.4, 0.4, 0.4), 0.02, 3.0);
  Fluid<double> fluid(o);
  fluid.fill({{Vec3(0.2, 0.2, 0.3), Vec3(0.22, 0.22, 0.301)}, {Vec3(0, 0, 0), Vec3(0.4, 0.4, 0.05)}});
  for (int s = 0; s < 50; ++s) fluid.step();
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
}

}  // namespace
}  // namespace lahar::lbm
