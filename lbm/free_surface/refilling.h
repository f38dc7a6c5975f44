#pragma once
// What cells hold that become interface cells. Refilling by equilibrium, the most robust of the ways compared by
// Schwarzmeier & Ruede 2022 (arXiv:2207.13962): a cell that was gas gets the equilibrium at the mean density and
// velocity of its wet neighbours, without those that were gas too; one that a drop has moved into, at the drop's. What
// is of a body in it moves as the body (docs/decisions/0059, 0087). A liquid cell that becomes interface keeps its
// populations.
#include "lbm/collision/coverage_weight.h"
#include "lbm/collision/equilibrium.h"
#include "lbm/free_surface/block_changes.h"

namespace lahar::lbm {

/// What refilling needs to know of the collision.
struct RefillLaw {
  EquilibriumOrder order = EquilibriumOrder::fourth;  ///< of its equilibrium
  CoverageWeightLaw coverage_weight = {};             ///< B of the drag that bodies wrote into a cell
};

/// Fills the new interface cells of a block, for several blocks at once: reads types and outgoing populations of
/// neighbour cells, writes populations that belong to its own cells. All types are final, all blocks exist.
template <class Real>
void refill(FluidGrid<Real>& grid, const LevelChanges<Real>& changes, BlockIndex b, Parity parity,
            const RefillLaw& law);

/// Mass, density, fill level and populations of one interface cell with some liquid (lu), in the equilibrium of
/// `moments`; what is of a body in it moves as the body.
template <class Real>
void refill_cell(FluidGrid<Real>& grid, CellPlace place, Parity parity, CellMoments<Real> moments, Real liquid,
                 const RefillLaw& law);

/// What was a liquid cell, beside gas from now on, holds as a full interface cell. Its block has surface fields.
template <class Real>
void expose_cell(FluidGrid<Real>& grid, CellPlace place, Parity parity);

extern template void expose_cell<float>(FluidGrid<float>&, CellPlace, Parity);
extern template void expose_cell<double>(FluidGrid<double>&, CellPlace, Parity);
extern template void refill<float>(FluidGrid<float>&, const LevelChanges<float>&, BlockIndex, Parity, const RefillLaw&);
extern template void refill<double>(FluidGrid<double>&, const LevelChanges<double>&, BlockIndex, Parity,
                                    const RefillLaw&);
extern template void refill_cell<float>(FluidGrid<float>&, CellPlace, Parity, CellMoments<float>, float,
                                        const RefillLaw&);
extern template void refill_cell<double>(FluidGrid<double>&, CellPlace, Parity, CellMoments<double>, double,
                                         const RefillLaw&);

}  // namespace lahar::lbm
