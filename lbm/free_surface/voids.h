#pragma once
// Voids that are cut off from the gas: interface cells that are not full although none of their neighbours is gas. No
// link tells them the gas pressure any more, so that they would stand half empty in water under any pressure. They take
// liquid from their liquid neighbours as long as those are above the gas pressure: at most what would bring them down
// to it half-way, and what is missing flows in. Only cells under pressure are touched, and mass is moved, not made,
// with its momentum (liquid_transfer.h).
//
// As gathers, like the excess mass: voids note what they ask (find), liquid cells what they pay, all who ask together
// at most half of their pressure (pay); then what was noted changes hands (close).
#include "lbm/collision/equilibrium.h"
#include "lbm/free_surface/block_changes.h"

namespace lahar::lbm {

template <class Real>
class Voids {
 public:
  /// `parity` is that of the coming step, `order` that of the collision operator's equilibrium.
  Voids(FluidGrid<Real>& grid, LevelChanges<Real>& changes, Parity parity, EquilibriumOrder order)
      : grid_(grid), changes_(changes), parity_(parity), order_(order) {}

  void find(BlockIndex b);
  void pay(BlockIndex b);
  void close(BlockIndex b);

 private:
  /// rho - 1 of a liquid cell, as it sends it out; at least 0.
  [[nodiscard]] Real pressure_of(CellPlace place) const;
  void ask(BlockIndex b, int cell);

  FluidGrid<Real>& grid_;
  LevelChanges<Real>& changes_;
  const Parity parity_;
  const EquilibriumOrder order_;
};

extern template class Voids<float>;
extern template class Voids<double>;

}  // namespace lahar::lbm
