#pragma once
// The blocks of the fluid: topology, storage, and the geometry cut into them.
#include <array>
#include <cstdint>
#include <vector>

#include "lbm/grid/block.h"
#include "lbm/grid/block_topology.h"
#include "lbm/grid/domain.h"
#include "lbm/step/streaming.h"

namespace lahar::lbm {

/// A cell: its block and its index there.
struct CellPlace {
  BlockIndex block = kNoBlock;
  int cell = 0;
};

template <class Real>
class FluidGrid {
 public:
  /// `velocity_to_lu` converts the walls' velocities.
  FluidGrid(DomainSpec spec, double velocity_to_lu);

  [[nodiscard]] const Domain& domain() const { return domain_; }
  [[nodiscard]] const BlockTopology& topology() const { return topology_; }
  /// The blocks that this process computes, in Morton order; loops run over these. Today they are all that exist.
  [[nodiscard]] const std::vector<BlockIndex>& owned() const { return topology_.active(); }
  [[nodiscard]] bool exists(BlockIndex b) const { return blocks_[static_cast<std::size_t>(b)] != nullptr; }
  [[nodiscard]] Block<Real>& block(BlockIndex b) { return *blocks_[static_cast<std::size_t>(b)]; }
  [[nodiscard]] const Block<Real>& block(BlockIndex b) const { return *blocks_[static_cast<std::size_t>(b)]; }
  [[nodiscard]] const std::array<Block<Real>*, 27>& around(BlockIndex b) const {
    return around_[static_cast<std::size_t>(b)];
  }

  /// Without a look at the block itself, which is seldom in the cache: passes that concern few blocks ask this first.
  [[nodiscard]] bool has_surface(BlockIndex b) const { return has_surface_[static_cast<std::size_t>(b)] != 0; }
  [[nodiscard]] bool has_walls(BlockIndex b) const { return has_walls_[static_cast<std::size_t>(b)] != 0; }

  /// The block at a block coordinate; made if missing: gas at rest, walls and sinks cut in.
  BlockIndex require_block(const Vec3i& coordinate);
  /// The same for many: in Morton order, cut in parallel.
  void require_blocks(const std::vector<Vec3i>& coordinates);
  /// Makes sure that all 26 neighbours of a cell lie in existing blocks.
  void require_neighbours(CellPlace place);
  /// The blocks (bits by neighbour_slot) that hold some of the 26 neighbours of a cell, or that lie around a block, and
  /// do not exist.
  [[nodiscard]] std::uint32_t missing_around(CellPlace place) const;
  [[nodiscard]] std::uint32_t missing_neighbours(BlockIndex b) const;
  /// Appends the coordinates of a block's neighbours of these slots.
  void add_coordinates(BlockIndex b, std::uint32_t slots, std::vector<Vec3i>& coordinates) const;
  void release(BlockIndex b);
  /// Takes away the walls that open by `time` (s): their cells are gas. Returns the blocks in which something changed;
  /// liquid cells there may lie beside gas.
  std::vector<BlockIndex> open_walls_by(double time);
  /// From now on the walls' velocities have these lattice units.
  void set_velocity_to_lu(double velocity_to_lu);

  /// The cell next to `place` along velocity i; block kNoBlock if it does not exist.
  [[nodiscard]] CellPlace neighbour(CellPlace place, int i) const {
    return {topology_.neighbours(place.block)[kNeighbours.slot(i, place.cell)], kNeighbours.cell(i, place.cell)};
  }
  [[nodiscard]] CellType type(CellPlace p) const {
    return p.block == kNoBlock ? CellType::gas : block(p.block).type[static_cast<std::size_t>(p.cell)];
  }
  /// The four values of pair (a, a+1) at a cell whose neighbours exist.
  [[nodiscard]] PairAccess<Real> access(CellPlace p, int a, Parity parity) {
    return access_pair(block(p.block), *around(p.block)[kNeighbours.slot(a, p.cell)], p.cell, a, parity);
  }

  /// Optional fields, given with sensible contents: fill level from the types; no body.
  SurfaceFields<Real>& require_surface(BlockIndex b);
  /// require_surface in two parts: storage, one block at a time; contents, for several blocks at once.
  void acquire_surface(BlockIndex b);
  void clear_surface(BlockIndex b);
  BodyFields<Real>& require_body(BlockIndex b);
  /// Zero where nothing was written yet; the body kernel applies it, so the block gets body fields too.
  ImpulseFields<Real>& require_impulse(BlockIndex b);
  /// After the sweep: impulses act once.
  void release_impulses();
  void release_surface(BlockIndex b);
  void release_body(BlockIndex b);
  /// Lists the interface cells of a block again and counts its wet cells, after types have changed.
  void relist(BlockIndex b) { list_cells(b), release_unused_surface(b); }
  /// The same in two parts: the first for several blocks at once.
  void list_cells(BlockIndex b);
  void release_unused_surface(BlockIndex b) {
    if (block(b).surface && block(b).surface->count == 0) release_surface(b);
  }

  [[nodiscard]] Vec3i lowest_cell(BlockIndex b) const { return topology_.coordinate(b) * kBlockWidth; }
  [[nodiscard]] Vec3 centre(BlockIndex b, int cell) const {
    const auto p = cell_position(cell);
    return domain_.centre(lowest_cell(b) + Vec3i(p[0], p[1], p[2]));
  }
  [[nodiscard]] std::size_t bytes() const;

  /// State of a checkpoint; loading needs an empty grid of the same domain (fluid_transfer.cpp).
  void transfer(Archive& archive);

 private:
  void make_blocks(const std::vector<BlockIndex>& made);
  void link_block(BlockIndex b);
  void transfer_types(Archive& archive);
  void transfer_surfaces(Archive& archive);
  void transfer_bodies(Archive& archive);
  void transfer_wall_links(Archive& archive);
  void release_impulse(BlockIndex b);

  Domain domain_;
  double velocity_to_lu_;
  std::uint64_t births_ = 0;
  BlockTopology topology_;
  std::vector<Block<Real>*> blocks_;
  std::vector<std::array<Block<Real>*, 27>> around_;
  std::vector<std::uint8_t> has_surface_, has_walls_;  // by block index
  ObjectPool<Block<Real>> block_pool_;
  ObjectPool<SurfaceFields<Real>> surface_pool_;
  ObjectPool<BodyFields<Real>> body_pool_;
  ObjectPool<ImpulseFields<Real>> impulse_pool_;
  std::vector<BlockIndex> with_impulse_;  // some of them may have been released since
  PopulationPool<Real> population_pool_;
};

extern template class FluidGrid<float>;
extern template class FluidGrid<double>;

}  // namespace lahar::lbm
