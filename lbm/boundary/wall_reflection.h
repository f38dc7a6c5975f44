#pragma once
// After a sweep: populations that went into a wall come back.
//
// Half-way bounce-back (Ladd 1994): f_opposite(i)(x, t+1) = f_i*(x, t) - 6 w_i rho c_i . u_wall.
//
// Interface cells at such a wall are braked by viscosity alone (surface_cells_at_walls.h).
//
// Interpolated (Bouzidi, Firdaouss & Lallemand 2001, linear), with the wall at the share q of the link:
//   q < 1/2:   2q f_i*(x, t) + (1 - 2q) f_i*(x - c_i, t) - 6 w_i c_i . u_wall
//   q >= 1/2:  [f_i*(x, t) + (2q - 1) f_opposite(i)*(x, t) - 6 w_i c_i . u_wall] / 2q
// f_i*(x - c_i, t) has just arrived at x, so that all of it is the cell's own data in Esoteric Pull. Where nothing
// arrives, in a gap or film of one cell, the link falls back to half-way. A body force a adds 3 w_i c_i . a times (1 -
// 2q), or (2q - 1)/2q: both rules then give f_i* at hydrostatic rest, as half-way does, so that liquid at rest stays at
// rest and no wall leaks under hydrostatic pressure. Mass: wall_balance.h.
//
// A free-slip wall along the lattice is a mirror (slip_wall.h). One at an angle to it moves so that its links exert
// little stress along it (wall_traction.h); a plug slides along it unchanged, steps or not. What moving and slipping
// walls add to a cell where they are cut into steps, the sum of -6 w_i rho c_i . u_wall, is booked (wall_balance.h):
// without it the steps would brake (docs/decisions/0013).
//
// A wall with a wall model that lies along the lattice is a mirror, too, and then brakes (wall_braking.h). One in steps
// moves as one that slips freely does, less what the law takes (wall_traction.h).
//
// A no-slip wall at an interface cell moves so that the traction of its links is the stress of a law
// (surface_cells_at_walls.h). Over all links through an area with the normal n, along the tangent t,
//   traction = rho M v . t - Q,  M = 6 sum w_i |c_i . n| (c_i . t)^2,
// sums over the velocities into the wall, Q what bounce-back off a wall at rest brings: at a wall along the lattice
// twice what the cell sends, else as its second moments Pi say,
//   Q = rho M u . t + P,  P = 9 sum w_i |c_i . n| (c_i . t) c_i . Pi . c_i,
// u the velocity of the cell; v is that less grad p / (2 rho), for half a step (docs/decisions/0076). In a linear
// profile with the stress nu u / y the wall then stands still. Across the stream it exerts nothing. Free slip and wall
// model are half-way.
#include <array>

#include "lbm/boundary/wall_load.h"
#include "lbm/collision/equilibrium.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Lattice units.
struct WallPhysics {
  double viscosity = 0;
  std::array<double, 3> acceleration{0, 0, 0};                    ///< body force per mass
  bool newtonian = true;                                          ///< the viscosity is that of the liquid at the wall
  EquilibriumOrder equilibrium_order = EquilibriumOrder::fourth;  ///< of the collision operator
};

/// Reflects at all wall cells of one block; `parity` is that of the coming step. What the walls get is added to `loads`
/// if that is given; results are the same with and without.
template <class Real>
void reflect_at_walls(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const WallPhysics& physics,
                      BlockWallLoads* loads = nullptr);

extern template void reflect_at_walls<float>(FluidGrid<float>&, BlockIndex, Parity, const WallPhysics&,
                                             BlockWallLoads*);
extern template void reflect_at_walls<double>(FluidGrid<double>&, BlockIndex, Parity, const WallPhysics&,
                                              BlockWallLoads*);

}  // namespace lahar::lbm
