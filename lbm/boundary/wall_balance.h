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
//
// Interface cells change their mass over links to wet cells, and, where liquid slips along steps, over those into the
// wall (docs/decisions/0077): behind a riser there is no cell that could fill the front, and what it lacks is what the
// treads before it took. What goes out goes with the cell's own fill level, what comes in with that of the cell up the
// wall.
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
  double owed = 0;      ///< gained by cells and not yet taken back: rounding, but where no wet cell is left to pay, lu
  double returned = 0;  ///< sum of |what was given back or taken| so far, lu

  void transfer(Archive& archive) {
    archive.value("owed", owed);
    archive.value("returned", returned);
  }
};

/// Before a step: mass of interface cells over their links into walls in steps along which the liquid slips. All wet
/// cells at such walls give back the sum, and what was owed before, in parts by their fill level. (Liquid cells alone
/// would pay for a whole film where few of them are left.)
template <class Real>
void exchange_through_steps(FluidGrid<Real>& grid, Parity parity, WallAccount& account);

template <class Real>
void balance_walls(FluidGrid<Real>& grid, WallAccount& account);

extern template void balance_walls<float>(FluidGrid<float>&, WallAccount&);
extern template void balance_walls<double>(FluidGrid<double>&, WallAccount&);
extern template void exchange_through_steps<float>(FluidGrid<float>&, Parity, WallAccount&);
extern template void exchange_through_steps<double>(FluidGrid<double>&, Parity, WallAccount&);

}  // namespace lahar::lbm
