#pragma once
// A change of the time step in the middle of a step, with the cells as they are (docs/decisions/0010).
//
// Between the exchange at the surface and the sweep every wet cell has its 19 incoming populations, and nothing else is
// read after. There the state goes from one lattice to the other. With r = new / old time step and the cell size fixed,
//   velocity      u' = r u + a (r - r^2) / 2    a: gravity in old units. The populations carry the velocity half a
//                                               force before the moment: water at rest stays exactly at rest.
//   density       ln rho' = r^2 ln rho          cs^2 ln rho is the enthalpy of the lattice fluid, which balances the
//                                               potential and u^2 / 2; to first order the pressure above the gas is
//                                               kept
//   viscosity     tau' - 1/2 = r (tau - 1/2)    in each cell: of eddies and of flow laws too, which are functions of
//                                               the physical strain rate
//   stress        S = -2/3 rho tau D (Chapman & Enskog), D' = r D:  S' = r (rho' tau') / (rho tau) S
// f' = f_eq(rho', u') + that factor x the non-equilibrium part. Incoming populations, because after a collision the
// stress is -2/3 rho (tau - 1) D: at tau = 1 it says nothing about D. (Thuerey, Pohl, Ruede, Oechsner & Koerner 2006,
// Comput. Fluids 35, 934, scale the non-equilibrium likewise.) The odd part, which places walls with two relaxation
// times, follows from gradients of what is even, the pressure and rho u u, and from the force, all of which go as r^2:
// r^2 (rho' tau_odd') / (rho tau_odd). Central moments drop it.
//
// Fill levels are kept: the volume of the liquid is what is physical. Its mass in lattice units, volume x rho, changes
// with the compression of the lattice fluid; the sum of that is returned, for the ledger.
#include "lbm/grid/fluid_grid.h"
#include "lbm/step/sweep.h"

namespace lahar::lbm {

/// Brings one block to a time step `ratio` times as long: populations and masses of its wet cells, velocities of its
/// bodies, momentum that the coming collision is given. Walls follow the grid (FluidGrid::set_velocity_to_lu). `before`
/// are the parameters of the sweep so far, `parity` that of the coming one. Returns the mass that came in, lu. Writes
/// locations of this block's cells alone.
template <class Real>
double rescale_block(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const SweepParameters& before, double ratio);

extern template double rescale_block<float>(FluidGrid<float>&, BlockIndex, Parity, const SweepParameters&, double);
extern template double rescale_block<double>(FluidGrid<double>&, BlockIndex, Parity, const SweepParameters&, double);

}  // namespace lahar::lbm
