#pragma once
// Walls of the wall model that lie along the lattice: mirrors that take the momentum off which the law asks for.
//
// What comes out of the mirror over the links (t, n) and (-t, n), t an axis along the wall, n out of it, is changed by
// -rho tau_t / 2 and rho tau_t / 2, tau the stress of the law over density. That is no mass, the momentum -rho tau_t,
// and the momentum flux of a stress tau_t at the wall: where the flow does not change along the wall it is what
// half-way bounce-back off a wall that moves with the right velocity would send (wall_reflection.h), and with tau = nu
// u / y a linear profile stays one. Elsewhere the mirror hands on to the next cell what moves along the wall, and
// eddies live; bounce-back sends it back where it came from. Over the edge of a wall one link of the two is there: it
// gets all, and what is straight across the opposite.
//
// The law is that of the velocity after braking: u' = u - tau(u'), for a tau that grows as u. So no viscosity is too
// large. It acts when all else that is on its way to the cell is known, after the pass over the surface: books of mass
// do not see it.
#include "lbm/boundary/wall_load.h"
#include "lbm/boundary/wall_reflection.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Before a sweep, at the wall cells of one block; what the walls get is added to `loads` if that is given.
template <class Real>
void brake_at_walls(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const WallPhysics& physics,
                    BlockWallLoads* loads = nullptr);

extern template void brake_at_walls<float>(FluidGrid<float>&, BlockIndex, Parity, const WallPhysics&, BlockWallLoads*);
extern template void brake_at_walls<double>(FluidGrid<double>&, BlockIndex, Parity, const WallPhysics&,
                                            BlockWallLoads*);

}  // namespace lahar::lbm
