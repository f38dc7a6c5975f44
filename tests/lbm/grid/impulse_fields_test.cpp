// Momentum that cells get from outside: held only where somebody writes, applied once.
#include <gtest/gtest.h>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

Vec3 momentum(const Fluid<double>& fluid) {
  Vec3 sum = Vec3::Zero();
  fluid.for_each_wet_cell([&](const WetCell& c) { sum += (1 + 3 * c.pressure) * c.velocity; });
  return sum;
}

TEST(ImpulseFields, ActOnce) {
  Fluid<double> fluid(lattice_options({16, 8, 8}, 0.1));
  fluid.fill_everything([](const Vec3&) { return Vec3::Zero().eval(); }, [](const Vec3&) { return 0.0; });
  auto& grid = fluid.grid();
  ASSERT_EQ(grid.owned().size(), 2U);
  const BlockIndex b = grid.owned()[1];
  ImpulseFields<double>& impulse = grid.require_impulse(b);
  EXPECT_EQ(impulse.y[100], 0);
  EXPECT_EQ(&grid.require_impulse(b), &impulse);
  impulse.x[3] = 1e-3, impulse.y[100] = -2e-3, impulse.z[511] = 5e-4;
  EXPECT_EQ(grid.block(grid.owned()[0]).impulse, nullptr);
  for (int s = 0; s < 3; ++s) {
    fluid.step();
    EXPECT_EQ(grid.block(b).impulse, nullptr);
    EXPECT_LT((momentum(fluid) - Vec3(1e-3, -2e-3, 5e-4)).norm(), 1e-15);
  }
}

TEST(ImpulseFields, GoWithTheirBlock) {
  FluidGrid<float> grid(lattice_options({16, 8, 8}, 0.1).domain, 1);
  const BlockIndex b = grid.require_block(Vec3i(0, 0, 0));
  grid.require_impulse(b).x[0] = 1;
  grid.release_body(b);
  EXPECT_EQ(grid.block(b).impulse, nullptr);
  grid.require_impulse(b).x[0] = 1;
  grid.release(b);
  grid.release_impulses();
  EXPECT_EQ(grid.require_impulse(grid.require_block(Vec3i(1, 0, 0))).x[0], 0);  // storage is used again
}

}  // namespace
}  // namespace lahar::lbm
