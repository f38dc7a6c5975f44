#pragma once
// After a step: full interface cells become liquid, empty ones gas; the layer between liquid and gas stays closed; the
// mass that is left over goes to neighbours. Nothing is lost: what finds no taker goes to a pool that is paid back.
//
// Koerner et al. 2005, section 2.3, with: thresholds 1.01 and -0.01; filling wins over emptying; new interface cells
// get the equilibrium at the mean density and velocity of their wet neighbours (refilling by equilibrium was the most
// robust of those compared by Schwarzmeier & Ruede 2022). Where a body covers part of a cell the mass of the cell
// includes the body's share: empty means that only the body is left (docs/coupling.md). Spray moves on as a whole
// (drops.h).
#include "lbm/boundary/wall_balance.h"
#include "lbm/free_surface/cell_flags.h"
#include "lbm/grid/fluid_grid.h"
#include "lbm/step/sweep.h"

namespace lahar::lbm {

/// What left the tracked cells, in lattice mass units, and how often the rules for unresolved liquid were used.
struct LiquidAccount {
  double outflow = 0;           ///< left through open faces
  double inflow = 0;            ///< came in through inflow boxes (inflow.h)
  double rescaled = 0;          ///< added by changes of the time step (rescale.h)
  double pool = 0;              ///< waiting to be paid back to interface cells
  double pooled_total = 0;      ///< sum of all that ever went through the pool (absolute)
  std::int64_t drop_moves = 0;  ///< moves of spray cells (drops.h)
  std::int64_t limited = 0;     ///< cell updates with a limited stress (collision/stress_limit.h)
  std::int64_t exposed = 0;     ///< cell updates with a bounded relaxation rate (same place)
  WallAccount walls;            ///< mass that interpolated walls took and gave (boundary/wall_balance.h)

  void transfer(Archive& archive) {
    archive.value("outflow", outflow);
    archive.value("inflow", inflow);
    archive.value("rescaled", rescaled);
    archive.value("pool", pool);
    archive.value("pooled_total", pooled_total);
    archive.value("drop_moves", drop_moves);
    archive.value("limited", limited);
    archive.value("exposed", exposed);
    archive.part("walls", walls);
  }
};

/// The whole conversion after a sweep: begin before it, flag for every swept block with a surface, then run. `parity`
/// is that of the coming step. Deterministic whatever the thread count: cells are judged in parallel, changed in the
/// order of blocks and cells.
template <class Real>
class CellConversion {
 public:
  void begin(const FluidGrid<Real>& grid);
  /// Judges the cells of a block as soon as it has been swept, while its numbers are in the cache; for several blocks
  /// at once. `k` is its place in the list of active blocks, `note` that of its sweep.
  void flag(FluidGrid<Real>& grid, std::size_t k, Parity parity, const SweepNote& note);
  void run(FluidGrid<Real>& grid, Parity parity, LiquidAccount& account);
  /// Makes a gas cell an interface cell without liquid, in the equilibrium of given moments; before a step.
  void wet(FluidGrid<Real>& grid, CellPlace place, Parity parity, const CellMoments<Real>& moments);
  /// State of a checkpoint: what outlives a step.
  void transfer(Archive& archive) {
    archive.value("round", round_);
    archive.value("pool_cursor", pool_cursor_);
  }

 private:
  struct Excess {
    CellPlace place;
    Real mass;
  };
  void relist_touched(FluidGrid<Real>& grid, Parity parity);
  void fill_cells(FluidGrid<Real>& grid, Parity parity);
  void fill_covered(FluidGrid<Real>& grid, CellPlace place) const;
  void wet_neighbours(FluidGrid<Real>& grid, CellPlace place);
  [[nodiscard]] CellMoments<Real> mean_around(FluidGrid<Real>& grid, CellPlace place, Parity parity) const;
  void set_interface(FluidGrid<Real>& grid, CellPlace place, Parity parity, const CellMoments<Real>& m, Real liquid);
  SurfaceFields<Real>& require_surface(FluidGrid<Real>& grid, BlockIndex b);
  void open_interface(FluidGrid<Real>& grid, CellPlace place);
  void settle_interface(FluidGrid<Real>& grid, CellPlace place, Parity parity, const CellMoments<Real>& m,
                        Real liquid) const;
  void empty_cells(FluidGrid<Real>& grid, Parity parity);
  void expose_liquid(FluidGrid<Real>& grid, CellPlace place, Parity parity);
  void move_drops(FluidGrid<Real>& grid, Parity parity, LiquidAccount& account);
  void move_drop(FluidGrid<Real>& grid, CellPlace place, const Drop<Real>& drop, Parity parity, LiquidAccount& account);
  void distribute(FluidGrid<Real>& grid, LiquidAccount& account);
  void close_voids(FluidGrid<Real>& grid, Parity parity);
  void pay_pool(FluidGrid<Real>& grid, LiquidAccount& account);
  void touch(BlockIndex b);
  [[nodiscard]] bool is_fresh(CellPlace p) const;

  std::vector<Flagged<Real>> flagged_;  // by block index
  std::uint64_t round_ = 0;
  std::vector<BlockIndex> with_surface_;           // when cells were flagged
  std::vector<double> left_;                       // by place in the list of active blocks
  std::vector<std::vector<std::uint16_t>> voids_;  // by place in with_surface_
  std::vector<CellPlace> opened_;                  // gas cells that become interface beside filled ones
  std::vector<Excess> excess_;
  std::vector<std::vector<std::uint16_t>> fresh_;  // new interface cells of this step, by block index
  std::vector<BlockIndex> touched_;
  std::vector<BlockIndex> new_surfaces_;
  std::vector<std::uint8_t> is_touched_;
  std::size_t pool_cursor_ = 0;
};

extern template class CellConversion<float>;
extern template class CellConversion<double>;

}  // namespace lahar::lbm
