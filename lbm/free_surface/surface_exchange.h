#pragma once
// Before a step: interface cells exchange mass with their wet neighbours, and get the populations that would come from
// the gas.
//
// Mass. By whole links (Koerner, Thies, Hofmann, Thuerey & Ruede 2005, Eq. 13-15) a cell would gain
//   dm_i = k_i N_i,  N_i = f_opposite(i) coming in - f_i that went out,
// with k_i = 1 to liquid, (F + F_neighbour)/2 to interface, 0 to gas. Where liquid flows along its surface that moves
// the surface at 2/3 of its speed and lets it grow rough (docs/decisions/0066). So mass crosses faces, and only as much
// of each as is wet: all of a face to liquid; between interface cells, where the flux Phi goes from A to B,
//   a = (F_A + F_B)/2 - Phi (F_B - F_A)/2,
// the mean over the step of what lies behind the face (Lax & Wendroff); nothing to gas. The links across a face to
// liquid are those of the lattice, so that what the liquid cell loses is what its neighbours gain: the link straight
// across, and by half each diagonal link that passes the face on one of its two ways around the edge. What lies between
// two interface cells goes by their own flux (face_sums.h). A diagonal link keeps its half and its k where a wall or
// gas lies on that way. What one cell gains the other loses.
//
// Missing populations (same paper, Eq. 11; only those from gas, as Bogner et al. 2015 and Schwarzmeier et al. 2023
// found better than the choice by the surface normal): f_opposite(i) = f_i^eq + f_opposite(i)^eq - f_i
// (anti-bounce-back); the terms linear in u cancel in the sum. The equilibrium is that of the collision operator: with
// another order a surface that moves along itself would bear a stress of rho u^2/6 across its motion
// (docs/decisions/0065). The rule sets a pressure half a link from the cell's centre, wherever the surface lies. So
// that it is the gas pressure on the surface itself, the density in it is that at the link's middle,
//   rho - 1 = gas + 3 (d + a . c_i / 2),
// with a = grad p / rho (surface_gradient.h) and d = a . (centre - surface) from the fill level (surface_plane.h):
// second order in the place of the surface, exact for water at rest at any angle to the lattice, and the plain rule in
// free fall, where a = 0 (docs/decisions/0007).
//
// The rule also makes the shear stress vanish half a link out; surface_shear.h puts that right where it counts.
//
// With surface tension the pressure on the surface is that of the gas plus sigma times the curvature (curvature.h).
#include "lbm/collision/equilibrium.h"
#include "lbm/free_surface/shear_row.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Lattice units.
template <class Real>
struct SurfacePhysics {
  EquilibriumOrder equilibrium_order = EquilibriumOrder::fourth;  ///< of the collision operator
  Real largest_gradient = 0;  ///< of |a|: beyond it densities are sound and splash, no weight of liquid; 0: plain rule
  Real surface_tension = 0;   ///< sigma over the density; 0 is off
  Real gravity[3] = {};       ///< lu
  Real weight = 0;            ///< what |a| is compared with where the surface has no clear normal (surface_shear.h)
};

/// Treats the interface cells of one block; marks those that are exposed to gas on half of their sides, whose
/// relaxation rate is bounded (collision/stress_limit.h). Writes mass and rates of this block and locations that
/// belong to its cells alone. `shear` are the block's rows of measure_shear, null where the viscous stress at the
/// surface does not count.
template <class Real>
void exchange_surface(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const SurfacePhysics<Real>& physics,
                      const ShearRow<Real>* shear);

/// Notes the density of the liquid cells of a block that has just got its surface fields, from what they send out: the
/// coming exchange looks at it before a sweep has written any.
template <class Real>
void note_densities(FluidGrid<Real>& grid, BlockIndex b, Parity parity);

extern template void exchange_surface<float>(FluidGrid<float>&, BlockIndex, Parity, const SurfacePhysics<float>&,
                                             const ShearRow<float>*);
extern template void exchange_surface<double>(FluidGrid<double>&, BlockIndex, Parity, const SurfacePhysics<double>&,
                                              const ShearRow<double>*);

}  // namespace lahar::lbm
