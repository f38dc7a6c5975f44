// Cells of the fluid and its largest speed: rows and their largest.
#include "cases/observers/fluid_cells.h"

#include <algorithm>

#include "tests/cases/observers/heap_of_water.h"

namespace lahar::cases {
namespace {

using FluidCellsOfHeap = HeapOfWater;

TEST_F(FluidCellsOfHeap, MostCellsOfTheRows) {
  first_row();
  const FluidCells& cells = *observers_->find<FluidCells>();
  const FluidView& fluid = *simulation_->fluid();
  EXPECT_GE(fluid.wet_cells(), 20u * 8u * 15u);
  std::uint64_t most = fluid.wet_cells(), blocks = fluid.active_blocks();
  double fastest = fluid.max_speed_lu();
  for (int row = 0; row < 4; ++row) {
    const Metrics metrics = take_row(10);
    most = std::max<std::uint64_t>(most, fluid.wet_cells());
    blocks = std::max<std::uint64_t>(blocks, fluid.active_blocks());
    fastest = std::max(fastest, fluid.max_speed_lu());
    EXPECT_EQ(cells.most_wet_cells(), most);
    EXPECT_EQ(cells.most_blocks(), blocks);
    EXPECT_EQ(metrics.at("max_speed_lu"), fastest);
    EXPECT_EQ(metrics.at("speed_limited_cells_max"), static_cast<double>(fluid.limited_cells()));
  }
  EXPECT_GT(fastest, 0.01);
}

}  // namespace
}  // namespace lahar::cases
