#pragma once
// Before a step: interface cells exchange mass with their wet neighbours, and get the populations that would come from
// the gas.
//
// Mass (Koerner, Thies, Hofmann, Thuerey & Ruede 2005, Eq. 13-15): over the link to the neighbour at x + c_i,
//   dm_i = k_i (f_opposite(i) coming in - f_i that went out),  k_i = 1 to liquid, (F + F_neighbour)/2 to interface, 0 to gas.
// What one cell gains the other loses, to the last bit.
//
// Missing populations (same paper, Eq. 11; only those from gas, as Bogner et al. 2015 and Schwarzmeier et al. 2023
// found better than the choice by the surface normal): f_opposite(i) = f_i^eq + f_opposite(i)^eq - f_i at gas density
// (anti-bounce-back); the terms linear in u cancel in the sum. The rule sets the gas pressure half a link from the cell's
// centre whatever the fill level: first order, the level is felt with an error of up to half a cell
// (docs/decisions/0006).
#include "lbm/fluid_grid.h"

namespace lahar::lbm {

/// Treats the interface cells of one block; marks those that are exposed to gas on half of their sides, whose relaxation rate is
/// bounded (collision/stress_limit.h). Writes mass and rates of this block and locations that belong to its cells alone.
template <class Real>
void exchange_surface(FluidGrid<Real>& grid, BlockIndex b, Parity parity, Real gas_drho);

extern template void exchange_surface<float>(FluidGrid<float>&, BlockIndex, Parity, float);
extern template void exchange_surface<double>(FluidGrid<double>&, BlockIndex, Parity, double);

}  // namespace lahar::lbm
