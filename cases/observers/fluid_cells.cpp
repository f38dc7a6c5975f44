#include "cases/observers/fluid_cells.h"

#include <algorithm>

namespace lahar::cases {

FluidCells::FluidCells(const Observed& run) : Observer(run) {
  const FluidView& fluid = *run.simulation.fluid();
  column("wet_cells", "1", "liquid and interface cells", [&] { return static_cast<double>(fluid.wet_cells()); });
  column("max_speed_lu", "1", "largest speed of the last step, cells a step", [&] {
    return fluid.max_speed_lu();
  }).peak("max_speed_lu", "1", "largest `max_speed_lu` of the rows");
  result("speed_limited_cells_max", "1", "most cells in a step at the largest speed allowed",
         [&] { return static_cast<double>(fluid.limited_cells()); });
}

void FluidCells::sample(double) {
  const FluidView& fluid = *run_.simulation.fluid();
  most_wet_cells_ = std::max<std::uint64_t>(most_wet_cells_, fluid.wet_cells());
  most_blocks_ = std::max<std::uint64_t>(most_blocks_, fluid.active_blocks());
}

void FluidCells::transfer(Archive& archive) {
  archive.value("most_wet_cells", most_wet_cells_);
  archive.value("most_blocks", most_blocks_);
}

}  // namespace lahar::cases
