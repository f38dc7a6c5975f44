#pragma once
// After a step: full interface cells become liquid, empty ones gas; the layer between liquid and gas stays closed; the
// mass that is left over goes to neighbours. Nothing is lost: what finds no taker goes to a pool that is paid back.
//
// Koerner et al. 2005, section 2.3, with: thresholds 1.01 and -0.01; filling wins over emptying; new interface cells get
// the equilibrium at the mean density and velocity of their wet neighbours (refilling by equilibrium was the most robust
// of those compared by Schwarzmeier & Ruede 2022). Where a body covers part of a cell the mass of the cell includes the
// body's share: empty means that only the body is left (docs/coupling.md).
#include "lbm/fluid_grid.h"

namespace lahar::lbm {

/// What left the tracked cells, in lattice mass units.
struct LiquidAccount {
  double outflow = 0;       ///< left through open faces
  double pool = 0;          ///< waiting to be paid back to interface cells
  double pooled_total = 0;  ///< sum of all that ever went through the pool (absolute)
};

/// Sets flags and fill levels of one block's interface cells from their new mass; returns what left at the rim.
template <class Real>
double flag_conversions(FluidGrid<Real>& grid, BlockIndex b, std::vector<std::uint16_t>& filled,
                        std::vector<std::uint16_t>& emptied);

/// The whole conversion after a sweep. `parity` is that of the coming step. Deterministic whatever the thread count:
/// cells are judged in parallel, changed in the order of blocks and cells.
template <class Real>
class CellConversion {
 public:
  void run(FluidGrid<Real>& grid, Parity parity, LiquidAccount& account);

 private:
  struct Excess {
    CellPlace place;
    Real mass;
  };
  void flag(FluidGrid<Real>& grid, LiquidAccount& account);
  void fill_cells(FluidGrid<Real>& grid, Parity parity);
  void wet_neighbours(FluidGrid<Real>& grid, CellPlace place, Parity parity);
  void make_interface(FluidGrid<Real>& grid, CellPlace place, Parity parity);
  void empty_cells(FluidGrid<Real>& grid, Parity parity);
  void expose_liquid(FluidGrid<Real>& grid, CellPlace place, Parity parity);
  void distribute(FluidGrid<Real>& grid, LiquidAccount& account);
  void pay_pool(FluidGrid<Real>& grid, LiquidAccount& account);
  void touch(BlockIndex b);
  [[nodiscard]] bool is_fresh(CellPlace p) const;

  std::vector<std::vector<std::uint16_t>> filled_, emptied_;  // by block index
  std::vector<double> left_;
  std::vector<Excess> excess_;
  std::vector<std::vector<std::uint16_t>> fresh_;  // new interface cells of this step, by block index
  std::vector<BlockIndex> touched_;
  std::vector<std::uint8_t> is_touched_;
  std::size_t pool_cursor_ = 0;
};

extern template class CellConversion<float>;
extern template class CellConversion<double>;

}  // namespace lahar::lbm
