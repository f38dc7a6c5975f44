#pragma once
// What interface cells send across their faces: the flux of mass between two of them (surface_exchange.h).
//
// Across the face from A to B = A + e a step carries the links along e and, by half, those that pass the face on their
// way from one cell's column to the other's: in a uniform flow rho u . e, in water at rest nothing, link by link. Five
// velocities have c . e = 1. Their populations that A sends less the opposite five that B sends,
//   Phi = sum_(c.e = 1) f_c(A) - sum_(c.e = -1) f_c(B),
// are that flux with the links that pass beside taken from A and B themselves: equal in both cases, of second order in
// others, and known where a link would come from gas. So are the links into walls: along a wall that holds the water
// its own links carry nothing, but those on the other side, where it is faster, as much more; and mirrors give back
// what they get.
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Place of the face of a cell in SurfaceFields::sent; `side` is 1 or -1 along `axis`.
constexpr int face(int axis, int side) { return 2 * axis + (side < 0); }

/// Writes SurfaceFields::sent of one block: sums of shifted populations, lu. `parity` is that of the coming step. To be
/// called for all blocks with a surface before the exchange of the first.
template <class Real>
void sum_over_faces(const FluidGrid<Real>& grid, BlockIndex b, Parity parity);

extern template void sum_over_faces<float>(const FluidGrid<float>&, BlockIndex, Parity);
extern template void sum_over_faces<double>(const FluidGrid<double>&, BlockIndex, Parity);

}  // namespace lahar::lbm
