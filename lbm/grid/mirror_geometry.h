#pragma once
// Where links off walls that slip lead.
#include "lbm/grid/domain.h"

namespace lahar::lbm {

/// Whether a wall that slips is a mirror between a cell and the one beside it: what either sends down into the wall
/// below the other comes up again there (boundary/slip_wall.h). `along` leads to the cell beside, `into` down to the
/// wall. Both cells are free and have a wall right below that slips and that lies along the lattice at one of them at
/// least: over a bend into steps the last flat piece still is a mirror. Over steps the liquid slips in another way
/// (boundary/wall_traction.h), and a cell of steps that a no-slip wall holds has no mirror either. The two cells see
/// the same: populations change places, and nothing is lost.
bool is_mirror_between(const Domain& domain, const Vec3i& place, const Vec3i& along, const Vec3i& into);

}  // namespace lahar::lbm
