#pragma once
// After a sweep: populations that went into a wall come back. Half-way bounce-back (Ladd 1994):
//   f_opposite(i)(x, t+1) = f_i*(x, t) - 6 w_i rho c_i . u_wall.
// A free-slip wall is a wall that moves with the fluid's own tangential velocity, so that no shear reaches it; this
// works for any wall normal. At edges and steps the motion of the wall would add or take mass; the mean of c_i . u_wall
// over the cell's links is left out there, so that the links of a cell never change its mass.
#include "lbm/boundary/wall_load.h"
#include "lbm/fluid_grid.h"

namespace lahar::lbm {

/// Reflects at all wall cells of one block; `parity` is that of the coming step. What the walls get is added to `loads`
/// if that is given; results are the same with and without.
template <class Real>
void reflect_at_walls(FluidGrid<Real>& grid, BlockIndex b, Parity parity, BlockWallLoads* loads = nullptr);

extern template void reflect_at_walls<float>(FluidGrid<float>&, BlockIndex, Parity, BlockWallLoads*);
extern template void reflect_at_walls<double>(FluidGrid<double>&, BlockIndex, Parity, BlockWallLoads*);

}  // namespace lahar::lbm
