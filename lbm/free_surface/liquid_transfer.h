#pragma once
// Mass that liquid cells give or get in a conversion.
#include "lbm/collision/equilibrium.h"
#include "lbm/grid/fluid_grid.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

/// Adds mass (lu; below 0 takes it) to what a liquid cell sends out, as the equilibrium at the cell's own velocity: the
/// velocity stays, and mass takes its momentum along. (As a rest population it would leave the momentum behind:
/// docs/decisions/0067.) Writes locations that belong to this cell alone. `parity` is that of the coming step.
template <class Real>
void add_to_liquid(FluidGrid<Real>& grid, CellPlace place, Real mass, Parity parity, EquilibriumOrder order) {
  const CellMoments<Real> m = outgoing_moments(grid, place, parity);
  const auto part = [&](int i) {
    const Real of_density_one = static_cast<Real>(D3Q19::w(i)) + equilibrium(order, i, Real(0), m.u[0], m.u[1], m.u[2]);
    return mass * of_density_one;
  };
  Block<Real>& block = grid.block(place.block);
  block.f(0)[place.cell] += part(0);
  if (block.surface) block.surface->density[place.cell] += mass;
  for (int a = 1; a < D3Q19::q; a += 2) {
    const PairAccess<Real> pair = grid.access(place, a, parity);
    *pair.outgoing_a += part(a);
    *pair.outgoing_b += part(a + 1);
  }
}

}  // namespace lahar::lbm
