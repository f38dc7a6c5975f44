#pragma once
// What becomes of the cells of each block in a conversion (conversion.h): every phase writes what its own block's cells
// decide, later phases read it from neighbour blocks.
#include <algorithm>
#include <vector>

#include "lbm/free_surface/cell_flags.h"
#include "lbm/grid/cell_set.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// A drop that is free to move, and what it takes along.
template <class Real>
struct MovingDrop {
  Drop<Real> drop;
  Real liquid;
  bool leaves;  ///< through an open face
};

/// A drop that has moved in.
template <class Real>
struct Arrival {
  CellMoments<Real> moments;
  Real liquid;
};

/// What a converted cell holds too much (below 0: too little), lu.
template <class Real>
struct Excess {
  int cell;
  Real mass;
};

/// Excess mass that goes to interface neighbours in equal parts.
template <class Real>
struct Gift {
  Real part;
  bool to_covered;  ///< to neighbours that bodies cover, else to the others
};

/// Liquid that a cell owes, or lacks, asked of its neighbours in proportion to what they have.
template <class Real>
struct Claim {
  Real share;         ///< of what each of them has
  Real owed = 0;      ///< sum that is asked for
  bool from_covered;  ///< of neighbours that bodies cover, else of the others
};

/// What a cell that is asked pays for each unit of share.
template <class Real>
struct Payer {
  Real per_share;
  Real paid;    ///< to all that asked
  bool scaled;  ///< they asked for more than there is
};

template <class Real>
struct BlockChanges {
  Flagged<Real> flagged;  ///< by the sweep's look at each cell (cell_flags.h)
  double left = 0;        ///< liquid through open faces, lu
  CellSet opened;         ///< gas cells that become interface beside filled ones
  CellSet exposed;        ///< liquid cells that become interface beside emptied ones
  CellSet fresh;          ///< interface cells that were gas: opened, or a drop moved in
  std::vector<MovingDrop<Real>> moving;
  CellMap<Arrival<Real>> arrivals;
  std::vector<Excess<Real>> excess;
  CellMap<Gift<Real>> gifts;
  CellMap<Claim<Real>> claims;
  CellMap<Payer<Real>> payers;
  CellMap<Real> spills;       ///< to each liquid neighbour
  double pooled = 0;          ///< to the pool of isolated liquid, lu
  double pooled_total = 0;    ///< the same without signs
  double nearby = 0;          ///< of cells that bodies cover, to cells near by, lu
  double released = 0;        ///< volume of bodies that left the cells that emptied, cells (touching.h)
  std::int64_t moves = 0;     ///< of drops
  std::uint32_t missing = 0;  ///< blocks around fresh cells that are to be made, bits by neighbour_slot
  bool types_changed = false;
  bool new_surface = false;

  void clear() {
    flagged.clear();
    left = pooled = pooled_total = nearby = released = 0, moves = 0, missing = 0;
    opened.clear(), exposed.clear(), fresh.clear();
    moving.clear(), arrivals.clear(), excess.clear();
    gifts.clear(), claims.clear(), payers.clear(), spills.clear();
    types_changed = new_surface = false;
  }
};

/// What a block noted for its neighbours, as bits: asked before its changes are looked at, which are seldom in the
/// cache.
enum Noted : std::uint8_t { kFilled = 1, kEmptied = 2, kGifts = 4, kClaims = 8, kSpills = 16, kOwing = 32 };

/// The changes of all blocks, and which blocks a change reaches.
template <class Real>
class LevelChanges {
 public:
  /// For as many blocks as there are; one thread.
  void fit(const FluidGrid<Real>& grid) {
    if (blocks_.size() < grid.topology().capacity()) {
      blocks_.resize(grid.topology().capacity());
      near_.resize(blocks_.size(), 0);
      noted_.resize(blocks_.size(), 0);
    }
  }
  [[nodiscard]] BlockChanges<Real>& of(BlockIndex b) { return blocks_[static_cast<std::size_t>(b)]; }
  [[nodiscard]] const BlockChanges<Real>& of(BlockIndex b) const { return blocks_[static_cast<std::size_t>(b)]; }

  /// To be called by a phase that has noted something in its block.
  void note(BlockIndex b) {
    const BlockChanges<Real>& c = of(b);
    noted_[static_cast<std::size_t>(b)] = static_cast<std::uint8_t>(
        (c.flagged.filled.empty() ? 0 : kFilled) | (c.flagged.emptied.empty() ? 0 : kEmptied) |
        (c.flagged.owing.empty() ? 0 : kOwing) | (c.gifts.empty() ? 0 : kGifts) | (c.claims.empty() ? 0 : kClaims) |
        (c.spills.empty() ? 0 : kSpills));
  }

  /// Marks the blocks that cells of a block are next to; one thread.
  void note_reach(const FluidGrid<Real>& grid, BlockIndex b, const CellSet& cells) {
    for (std::uint32_t slots = cells.reach(); slots != 0; slots &= slots - 1) {
      const int slot = std::countr_zero(slots);
      const BlockIndex other = grid.topology().neighbours(b)[static_cast<std::size_t>(slot)];
      if (other != kNoBlock) near_[static_cast<std::size_t>(other)] |= 1U << (26 - slot);
    }
  }
  /// Lists the marked blocks in Morton order; one thread.
  void list_reached(const FluidGrid<Real>& grid) {
    reached_.clear();
    for (const BlockIndex b : grid.owned())
      if (near_[static_cast<std::size_t>(b)] != 0) reached_.push_back(b);
  }
  [[nodiscard]] const std::vector<BlockIndex>& reached() const { return reached_; }

  /// Calls visit(cell) for the cells of a block that have a neighbour in a set of cells, `member(changes of a block)`,
  /// once for each such neighbour, in the order in which these lie in space: neighbour_slot of their block, then cell.
  template <class Member, class Visit>
  void for_each_beside(const FluidGrid<Real>& grid, BlockIndex b, Noted kind, const Member& member,
                       const Visit& visit) const {
    for_each_near(grid, b, kind, [&](const BlockChanges<Real>& changes, int slot) {
      if (const CellSet& set = member(changes); !set.empty())
        set.facing(26 - slot).for_each([&](int from) { for_each_neighbour_in(from, 26 - slot, visit); });
    });
  }

  /// Calls visit(cell, value) for these cells, with what a map of values, `member(changes of a block)`, has for the
  /// neighbour.
  template <class Member, class Visit>
  void for_each_noted(const FluidGrid<Real>& grid, BlockIndex b, Noted kind, const Member& member,
                      const Visit& visit) const {
    for_each_near(grid, b, kind, [&](const BlockChanges<Real>& changes, int slot) {
      const auto& map = member(changes);
      if (map.empty()) return;
      map.cells().facing(26 - slot).for_each([&](int from) {
        const auto& value = map.at(from);
        for_each_neighbour_in(from, 26 - slot, [&](int cell) { visit(cell, value); });
      });
    });
  }

  /// Forgets all changes of the reached blocks.
  void clear() {
    for (const BlockIndex b : reached_) {
      near_[static_cast<std::size_t>(b)] = 0;
      noted_[static_cast<std::size_t>(b)] = 0;
      of(b).clear();
    }
    reached_.clear();
  }

 private:
  /// Calls visit(changes, slot) for the blocks that noted a kind of change and whose changes reach this one.
  template <class Visit>
  void for_each_near(const FluidGrid<Real>& grid, BlockIndex b, Noted kind, const Visit& visit) const {
    for (std::uint32_t slots = near_[static_cast<std::size_t>(b)]; slots != 0; slots &= slots - 1) {
      const int slot = std::countr_zero(slots);
      const BlockIndex other = grid.topology().neighbours(b)[static_cast<std::size_t>(slot)];
      if (noted_[static_cast<std::size_t>(other)] & kind) visit(of(other), slot);
    }
  }

  std::vector<BlockChanges<Real>> blocks_;  // by block index
  std::vector<std::uint32_t> near_;         // blocks with changes next to this one, bits by neighbour_slot
  std::vector<std::uint8_t> noted_;         // bits of Noted
  std::vector<BlockIndex> reached_;
};

}  // namespace lahar::lbm
