#pragma once
// Spray (drops.h) moves on by a cell; through an open face it leaves. Whether a drop is free to move is settled for all
// before the first one moves: neighbours that move together do not stand in each other's way. Of two that meet in one
// cell that with the lower velocity index moves, the other waits.
#include "lbm/free_surface/block_changes.h"

namespace lahar::lbm {

/// Notes the drops of a block that are free to move: reads types of neighbour blocks.
template <class Real>
void choose_moving_drops(const FluidGrid<Real>& grid, LevelChanges<Real>& changes, BlockIndex b);

/// Drops leave cells of the block and arrive in them: reads what neighbour blocks noted, writes types of this one.
template <class Real>
void move_drops(FluidGrid<Real>& grid, LevelChanges<Real>& changes, BlockIndex b);

extern template void choose_moving_drops<float>(const FluidGrid<float>&, LevelChanges<float>&, BlockIndex);
extern template void choose_moving_drops<double>(const FluidGrid<double>&, LevelChanges<double>&, BlockIndex);
extern template void move_drops<float>(FluidGrid<float>&, LevelChanges<float>&, BlockIndex);
extern template void move_drops<double>(FluidGrid<double>&, LevelChanges<double>&, BlockIndex);

}  // namespace lahar::lbm
