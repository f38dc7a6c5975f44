#pragma once
// The mass that walls add to liquid cells or take from them, and its return.
//
// Half-way bounce-back off a wall at rest returns to each cell what it sent into the wall. Interpolation does not, nor
// does a wall along which the liquid moves (it has a velocity, or slips) where it is cut into steps: the liquid then
// crosses the faces of the steps, into the wall on the treads and out of it on the risers. And they must not: in a flow
// along a wall that cuts the links at unlike distances the liquid crosses the surface half-way between the cells, out
// of some cells and into others, and only the sum along the wall is zero (up to second order). Forcing every cell to
// keep its mass would bring back the error of first order. So the sum over all cells is taken each step, and given back
// in equal parts to the rest populations of the same cells; the ledger of the liquid stays exact to rounding, and how
// much was moved is counted. What a reflection adds is in a cell after the next sweep, and only then taken back.
// Interface cells are left out: their mass changes over links to wet cells alone.
#include "lbm/boundary/slip_wall.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Whether a wall's links may change the mass of a cell.
inline bool moves_mass(const WallCell& wall, WallPlacement placement) {
  const bool still = wall.wall_velocity == std::array<float, 3>{0, 0, 0};
  if (wall.slip == WallSlip::no_slip) return placement == WallPlacement::interpolated || (!still && !wall.even);
  return !wall.even && !is_mirror(wall);
}

/// Whether some wall of the domain may.
bool some_wall_moves_mass(const Domain& domain);

struct WallAccount {
  double owed = 0;      ///< gained by cells and not yet taken back (rounding), lu
  double returned = 0;  ///< sum of |what was given back or taken| so far, lu

  void transfer(Archive& archive) {
    archive.value("owed", owed);
    archive.value("returned", returned);
  }
};

template <class Real>
void balance_walls(FluidGrid<Real>& grid, WallAccount& account);

extern template void balance_walls<float>(FluidGrid<float>&, WallAccount&);
extern template void balance_walls<double>(FluidGrid<double>&, WallAccount&);

}  // namespace lahar::lbm
