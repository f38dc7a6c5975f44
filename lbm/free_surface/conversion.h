#pragma once
// After a step: full interface cells become liquid, empty ones gas; the layer between liquid and gas stays closed; the
// excess mass goes to neighbours (excess_mass.h). Nothing is lost: what finds no taker goes to a pool that is paid back
// (isolated_liquid.h).
//
// Koerner et al. 2005, section 2.3, with: thresholds 1.01 and -0.01, wider at moving bodies (cell_flags.cpp); filling
// wins over emptying, but for cells that owe much (conversion.cpp); refilling by equilibrium (refilling.h). Where a
// body covers part of a cell the mass of the cell includes the body's share: empty means that only the body is left
// (docs/coupling.md). Spray moves on as a whole (drop_moves.h). Voids are closed (voids.h).
#include <memory>
#include <vector>

#include "lbm/boundary/wall_balance.h"
#include "lbm/step/cell_moments.h"
#include "lbm/step/fluid_level.h"

namespace lahar::lbm {

template <class Real>
struct BlockChanges;
template <class Real>
class LevelChanges;

/// What left the tracked cells, in lattice mass units, and how often the rules for unresolved liquid were used.
struct LiquidAccount {
  double outflow = 0;           ///< left through open faces
  double inflow = 0;            ///< came in through inflow boxes (inflow.h)
  double rescaled = 0;          ///< added by changes of the time step (rescale.h)
  double pool = 0;              ///< waiting to be paid back to interface cells (isolated_liquid.h)
  double pooled_total = 0;      ///< sum of all that ever went through the pool (absolute)
  double paid_nearby = 0;       ///< sum of all that was paid to cells near by (absolute)
  double released = 0;          ///< volume of bodies in cells that emptied since they were mapped (BodyFields)
  std::int64_t drop_moves = 0;  ///< moves of spray cells (drops.h)
  std::int64_t limited = 0;     ///< cell updates with a limited stress (collision/stress_limit.h)
  std::int64_t exposed = 0;     ///< cell updates with a bounded relaxation rate (same place)
  WallAccount walls;            ///< mass that walls took and gave (boundary/wall_balance.h)

  void transfer(Archive& archive) {
    archive.value("outflow", outflow);
    archive.value("inflow", inflow);
    archive.value("rescaled", rescaled);
    archive.value("pool", pool);
    archive.value("pooled_total", pooled_total);
    archive.value("paid_nearby", paid_nearby);
    archive.value("released", released);
    archive.value("drop_moves", drop_moves);
    archive.value("limited", limited);
    archive.value("exposed", exposed);
    archive.part("walls", walls);
  }
};

/// The whole conversion after a sweep: begin before it, flag for every swept block with a surface, then run. `parity`
/// is that of the coming step.
///
/// Every phase runs over blocks in parallel, and each block writes its own cells alone; what a cell does to another one
/// is noted by the one and taken by the other (block_changes.h). Between phases blocks are made and surface fields
/// handed out, in Morton order. The result depends on neither the number of threads nor the history of the blocks.
/// The phases are listed in docs/halo_exchange.md.
template <class Real>
class CellConversion {
 public:
  CellConversion();
  ~CellConversion();
  void begin(const FluidGrid<Real>& grid);
  /// Judges the cells of a block as soon as it has been swept, while its numbers are in the cache; for several blocks
  /// at once. `note` is that of its sweep.
  void flag(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const SweepNote& note);
  void run(FluidLevel<Real>& level, LiquidAccount& account);
  /// Makes a gas cell an interface cell without liquid, in the equilibrium of given moments; before a step.
  void wet(FluidLevel<Real>& level, CellPlace place, const CellMoments<Real>& moments);
  /// State of a checkpoint: what outlives a step.
  void transfer(Archive& archive) { archive.value("round", round_); }

 private:
  /// Calls phase(b) for the blocks that changes reach.
  template <class Phase>
  void for_reached(const Phase& phase) const;
  void list_surfaces(const FluidGrid<Real>& grid);
  void find_reached(const FluidGrid<Real>& grid);
  void keep_beside_filled(const FluidGrid<Real>& grid, BlockIndex b);
  void change_types(FluidGrid<Real>& grid, BlockIndex b);
  void convert_flagged(Block<Real>& block, BlockChanges<Real>& own) const;
  void note_missing(const FluidGrid<Real>& grid, BlockIndex b);
  void make_room(FluidGrid<Real>& grid);
  void distribute(FluidGrid<Real>& grid, Parity parity, EquilibriumOrder order);
  void book(const FluidGrid<Real>& grid, LiquidAccount& account);
  void close_voids(FluidGrid<Real>& grid, Parity parity, EquilibriumOrder order);

  std::unique_ptr<LevelChanges<Real>> changes_;
  std::vector<BlockIndex> with_surface_;  // in Morton order
  std::vector<double> nearby_;            // of covered cells, to those near by, lu by block index
  std::uint64_t round_ = 0;
  bool drops_ = false;  // whether some were flagged
};

extern template class CellConversion<float>;
extern template class CellConversion<double>;

}  // namespace lahar::lbm
