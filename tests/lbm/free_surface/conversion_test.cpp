#include "lbm/free_surface/conversion.h"

#include <gtest/gtest.h>

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
