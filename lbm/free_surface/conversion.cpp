#include "lbm/free_surface/conversion.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "lbm/free_surface/block_changes.h"
#include "lbm/free_surface/drop_moves.h"
#include "lbm/free_surface/excess_mass.h"
#include "lbm/free_surface/isolated_liquid.h"
#include "lbm/free_surface/refilling.h"
#include "lbm/free_surface/surface_exchange.h"
#include "lbm/free_surface/touching.h"
#include "lbm/free_surface/voids.h"

namespace lahar::lbm {

namespace {

constexpr std::uint64_t kVoidsEvery = 8;   ///< steps between looks for voids that are cut off from the gas
constexpr std::size_t kBlocksPerTask = 4;  ///< enough for a task, few enough that two threads end together

template <class Real>
const CellSet& filled_in(const BlockChanges<Real>& changes) {
  return changes.flagged.filled;
}

template <class Real>
const CellSet& owing_in(const BlockChanges<Real>& changes) {
  return changes.flagged.owing;
}

template <class Real>
const CellSet& emptied_in(const BlockChanges<Real>& changes) {
  return changes.flagged.emptied;
}

/// A cell beside one that owes much does not fill in this step: among bodies cells fill and open by turns, and what
/// lies beside them would owe more in every step that it waits (docs/decisions/0093).
template <class Real>
void wait_beside_owing(const FluidGrid<Real>& grid, LevelChanges<Real>& changes, BlockIndex b) {
  CellSet& filled = changes.of(b).flagged.filled;
  if (!filled.empty()) changes.for_each_beside(grid, b, kOwing, owing_in<Real>, [&](int cell) { filled.remove(cell); });
}

}  // namespace

template <class Real>
CellConversion<Real>::CellConversion() : changes_(std::make_unique<LevelChanges<Real>>()) {}
template <class Real>
CellConversion<Real>::~CellConversion() = default;

template <class Real>
template <class Phase>
void CellConversion<Real>::for_reached(const Phase& phase) const {
  const std::vector<BlockIndex>& reached = changes_->reached();
  parallel_for(0, reached.size(), kBlocksPerTask, [&](std::size_t k) { phase(reached[k]); });
}

template <class Real>
void CellConversion<Real>::list_surfaces(const FluidGrid<Real>& grid) {
  with_surface_.clear();
  for (const BlockIndex b : grid.owned())
    if (grid.has_surface(b)) with_surface_.push_back(b);
}

template <class Real>
void CellConversion<Real>::begin(const FluidGrid<Real>& grid) {
  ++round_;
  changes_->fit(grid);
  list_surfaces(grid);
}

template <class Real>
void CellConversion<Real>::flag(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const SweepNote& note) {
  BlockChanges<Real>& own = changes_->of(b);
  own.left = flag_conversions(grid, b, parity, round_, std::sqrt(note.speed_square), own.flagged);
  changes_->note(b);
}

template <class Real>
void CellConversion<Real>::run(FluidLevel<Real>& level, LiquidAccount& account) {
  FluidGrid<Real>& grid = level.grid;
  find_reached(grid);
  for_reached([&](BlockIndex b) { wait_beside_owing(grid, *changes_, b); });
  for_reached([&](BlockIndex b) { keep_beside_filled(grid, b); });
  for_reached([&](BlockIndex b) { change_types(grid, b); });
  if (drops_) {
    for_reached([&](BlockIndex b) { choose_moving_drops(grid, *changes_, b); });
    for_reached([&](BlockIndex b) {
      move_drops(grid, *changes_, b);
      if (!changes_->of(b).arrivals.empty()) note_missing(grid, b);
    });
  }
  make_room(grid);
  const EquilibriumOrder order = equilibrium_order(level.parameters.collision);
  const RefillLaw law{order, level.parameters.coverage_weight};
  for_reached([&](BlockIndex b) { refill(grid, *changes_, b, level.parity(), law); });
  distribute(grid, level.parity(), order);
  book(grid, account);
  changes_->clear();
  list_surfaces(grid);
  if (!nearby_.empty()) pay_nearby(grid, nearby_, account);
  account.pool -= pay_isolated_liquid(grid, with_surface_, account.pool, round_);
  if (round_ % kVoidsEvery == 0) close_voids(grid, level.parity(), order);
}

/// The blocks that hold flagged cells or neighbours of them.
template <class Real>
void CellConversion<Real>::find_reached(const FluidGrid<Real>& grid) {
  drops_ = false;
  for (const BlockIndex b : with_surface_) {
    const Flagged<Real>& flagged = changes_->of(b).flagged;
    if (flagged.empty()) continue;
    CellSet cells = flagged.filled;
    cells.add_all(flagged.emptied);
    for (const Drop<Real>& drop : flagged.drops) cells.add(drop.cell);
    drops_ = drops_ || !flagged.drops.empty();
    changes_->note_reach(grid, b, cells);
  }
  changes_->list_reached(grid);
}

/// Else filling wins: a cell beside a filled one does not empty.
template <class Real>
void CellConversion<Real>::keep_beside_filled(const FluidGrid<Real>& grid, BlockIndex b) {
  CellSet& emptied = changes_->of(b).flagged.emptied;
  if (!emptied.empty())
    changes_->for_each_beside(grid, b, kFilled, filled_in<Real>, [&](int cell) { emptied.remove(cell); });
}

/// Gas beside a filled cell becomes interface, as does liquid beside an emptied one.
template <class Real>
void CellConversion<Real>::change_types(FluidGrid<Real>& grid, BlockIndex b) {
  BlockChanges<Real>& own = changes_->of(b);
  Block<Real>& block = grid.block(b);
  const auto note = [&](CellSet& to, CellType type) {
    return [&block, &to, type](int cell) {
      if (block.type[static_cast<std::size_t>(cell)] == type) to.add(cell);
    };
  };
  changes_->for_each_beside(grid, b, kFilled, filled_in<Real>, note(own.opened, CellType::gas));
  changes_->for_each_beside(grid, b, kEmptied, emptied_in<Real>, note(own.exposed, CellType::liquid));
  convert_flagged(block, own);
  const auto become_interface = [&](int cell) { block.type[static_cast<std::size_t>(cell)] = CellType::interface; };
  own.opened.for_each(become_interface);
  own.exposed.for_each(become_interface);
  own.fresh = own.opened;
  own.types_changed = !own.excess.empty() || !own.opened.empty() || !own.exposed.empty();
  note_missing(grid, b);
}

/// Flagged cells become liquid or gas; their excess mass is noted. Liquid of emptied cells that a body covers
/// goes to those near by, which pay when it opens again (excess_mass.h).
template <class Real>
void CellConversion<Real>::convert_flagged(Block<Real>& block, BlockChanges<Real>& own) const {
  const auto convert = [&](int cell, CellType type, Real excess) {
    own.excess.push_back({cell, excess});
    block.type[static_cast<std::size_t>(cell)] = type;
    block.surface->fill_level[cell] = type == CellType::liquid ? Real(1) : Real(0);
    block.surface->mass[cell] = 0;
  };
  own.flagged.filled.for_each([&](int cell) {
    const Real rho = Real(1) + block.surface->density[cell];
    convert(cell, CellType::liquid, block.surface->mass[cell] - rho);
  });
  own.flagged.emptied.for_each([&](int cell) {
    own.released += released_share(block, cell);
    const Real liquid = block.surface->mass[cell] - body_share(block, cell);
    const bool covered = is_covered(block, cell);
    if (covered) own.nearby += static_cast<double>(liquid);
    convert(cell, CellType::gas, covered ? Real(0) : liquid);
  });
}

template <class Real>
void CellConversion<Real>::note_missing(const FluidGrid<Real>& grid, BlockIndex b) {
  BlockChanges<Real>& own = changes_->of(b);
  if (own.fresh.empty() || grid.missing_neighbours(b) == 0) return;
  own.fresh.for_each([&](int cell) { own.missing |= grid.missing_around({b, cell}); });
}

/// Blocks around new interface cells, and surface fields for them: storage, in Morton order.
template <class Real>
void CellConversion<Real>::make_room(FluidGrid<Real>& grid) {
  std::vector<Vec3i> wanted;
  for (const BlockIndex b : changes_->reached()) {
    BlockChanges<Real>& own = changes_->of(b);
    if (own.missing != 0) grid.add_coordinates(b, own.missing, wanted);
    if (grid.has_surface(b) || (own.fresh.empty() && own.exposed.empty())) continue;
    grid.acquire_surface(b);
    own.new_surface = true;
  }
  if (wanted.empty()) return;
  grid.require_blocks(wanted);
  changes_->fit(grid);
}

template <class Real>
void CellConversion<Real>::distribute(FluidGrid<Real>& grid, Parity parity, EquilibriumOrder order) {
  ExcessMass<Real> excess(grid, *changes_, parity, order);
  for_reached([&](BlockIndex b) { excess.offer(b); });
  const auto claims = [&](BlockIndex b) { return !changes_->of(b).claims.empty(); };
  if (std::ranges::any_of(changes_->reached(), claims)) {
    for_reached([&](BlockIndex b) { excess.pay(b); });
    for_reached([&](BlockIndex b) { excess.collect(b); });
  }
  for_reached([&](BlockIndex b) {
    excess.take(b);
    if (!changes_->of(b).types_changed) return;
    grid.list_cells(b);
    if (changes_->of(b).new_surface) note_densities(grid, b, parity);
  });
  for (const BlockIndex b : changes_->reached())
    if (changes_->of(b).types_changed) grid.release_unused_surface(b);
}

/// What the blocks noted, in Morton order.
template <class Real>
void CellConversion<Real>::book(const FluidGrid<Real>& grid, LiquidAccount& account) {
  nearby_.clear();
  for (const BlockIndex b : with_surface_) {
    const BlockChanges<Real>& own = changes_->of(b);
    account.outflow += own.left;
    account.pool += own.pooled;
    account.pooled_total += own.pooled_total;
    if (own.nearby != 0) {
      nearby_.resize(grid.topology().capacity(), 0.0);
      nearby_[static_cast<std::size_t>(b)] = own.nearby;
    }
    account.drop_moves += own.moves;
    account.released += own.released;
  }
}

template <class Real>
void CellConversion<Real>::close_voids(FluidGrid<Real>& grid, Parity parity, EquilibriumOrder order) {
  Voids<Real> voids(grid, *changes_, parity, order);
  parallel_for(0, with_surface_.size(), 16, [&](std::size_t k) { voids.find(with_surface_[k]); });
  for (const BlockIndex b : with_surface_)
    if (const CellSet& asking = changes_->of(b).claims.cells(); !asking.empty()) changes_->note_reach(grid, b, asking);
  changes_->list_reached(grid);
  for_reached([&](BlockIndex b) { voids.pay(b); });
  for_reached([&](BlockIndex b) { voids.close(b); });
  changes_->clear();
}

template <class Real>
void CellConversion<Real>::wet(FluidLevel<Real>& level, CellPlace place, const CellMoments<Real>& moments) {
  FluidGrid<Real>& grid = level.grid;
  grid.require_neighbours(place);
  const bool known = grid.has_surface(place.block);
  grid.require_surface(place.block);
  grid.block(place.block).type[static_cast<std::size_t>(place.cell)] = CellType::interface;
  refill_cell(grid, place, level.parity(), moments, Real(0),
              {equilibrium_order(level.parameters.collision), level.parameters.coverage_weight});
  grid.list_cells(place.block);
  if (!known) note_densities(grid, place.block, level.parity());
}

template class CellConversion<float>;
template class CellConversion<double>;

}  // namespace lahar::lbm
