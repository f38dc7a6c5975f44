#pragma once
// Blocks that no wet cell needs.
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Gives back blocks that hold no wet cell and no neighbour of one, and did not give bodies momentum in the last step.
template <class Real>
void release_dry_blocks(FluidGrid<Real>& grid);

extern template void release_dry_blocks<float>(FluidGrid<float>&);
extern template void release_dry_blocks<double>(FluidGrid<double>&);

}  // namespace lahar::lbm
