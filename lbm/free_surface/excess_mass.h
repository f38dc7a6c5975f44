#pragma once
// Where the excess mass of converted cells goes (Koerner et al. 2005, section 2.3), as gathers: each cell writes what
// it decides in its own block, and takes what its neighbours decided for it in the order in which they lie.
//
// What a converted cell has too much goes to its interface neighbours in equal parts. What it owes they pay in
// proportion to the liquid that they have, and not beyond it: a debt in equal parts would fall on cells that are as
// good as empty and make them owe more than a cell may before it is given up. A cell that is asked by several for more
// than it has gives each the same share of what it asked. What is left over goes to liquid neighbours, and without any
// to the pool (isolated_liquid.h). Cells that bodies cover hold no liquid of their own (covered_cells.h): they take and
// pay only where a cell has no other interface neighbours.
//
// A cell that a body covers is full or gas. The liquid that one holds when it empties goes to cells near by
// (isolated_liquid.h), and what one lacks that opens is paid for by the body's own cells at the surface, then by the
// same (coupling/grains/displaced_volume.h). Handed to its neighbours it would be pumped to where the cell opens and
// empties by turns (docs/decisions/0113).
//
// The four phases, each over all reached blocks before the next:
//   offer     reads types and masses around converted cells; notes gifts and claims
//   pay       reads claims; notes what each cell that is asked pays
//   collect   reads payments; what is left of debts is noted for liquid neighbours or the pool
//   take      reads gifts and what is left; masses change, and what liquid cells send out (liquid_transfer.h)
#include "lbm/collision/equilibrium.h"
#include "lbm/free_surface/block_changes.h"

namespace lahar::lbm {

template <class Real>
class ExcessMass {
 public:
  /// `parity` is that of the coming step, `order` that of the collision operator's equilibrium.
  ExcessMass(FluidGrid<Real>& grid, LevelChanges<Real>& changes, Parity parity, EquilibriumOrder order)
      : grid_(grid), changes_(changes), parity_(parity), order_(order) {}

  void offer(BlockIndex b);
  void pay(BlockIndex b);
  void collect(BlockIndex b);
  void take(BlockIndex b);

 private:
  void offer_excess(BlockIndex b, const Excess<Real>& excess);
  [[nodiscard]] Real unpaid(CellPlace place, const Claim<Real>& claim) const;
  void leave(CellPlace place, Real rest);

  FluidGrid<Real>& grid_;
  LevelChanges<Real>& changes_;
  const Parity parity_;
  const EquilibriumOrder order_;
};

extern template class ExcessMass<float>;
extern template class ExcessMass<double>;

}  // namespace lahar::lbm
