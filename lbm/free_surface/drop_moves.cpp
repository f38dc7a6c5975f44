#include "lbm/free_surface/drop_moves.h"

#include "lbm/free_surface/touching.h"

namespace lahar::lbm {

namespace {

/// The drop of a cell that moves along velocity i, if there is one.
template <class Real>
const MovingDrop<Real>* moving_along(const LevelChanges<Real>& changes, CellPlace place, int i) {
  if (place.block == kNoBlock) return nullptr;
  for (const MovingDrop<Real>& m : changes.of(place.block).moving)
    if (m.drop.cell == place.cell && m.drop.direction == i) return &m;
  return nullptr;
}

/// The drop that gets a cell.
template <class Real>
const MovingDrop<Real>* first_into(const FluidGrid<Real>& grid, const LevelChanges<Real>& changes, CellPlace place) {
  for (int i = 1; i <= 6; ++i)
    if (const auto* m = moving_along(changes, grid.neighbour(place, D3Q19::opposite(i)), i)) return m;
  return nullptr;
}

template <class Real>
void become_gas(Block<Real>& block, int cell) {
  block.type[static_cast<std::size_t>(cell)] = CellType::gas;
  block.surface->fill_level[cell] = Real(0);
  block.surface->mass[cell] = 0;
}

}  // namespace

template <class Real>
void choose_moving_drops(const FluidGrid<Real>& grid, LevelChanges<Real>& changes, BlockIndex b) {
  BlockChanges<Real>& own = changes.of(b);
  const Block<Real>& block = grid.block(b);
  for (const Drop<Real>& drop : own.flagged.drops) {
    const CellPlace place{b, drop.cell};
    if (grid.type(place) != CellType::interface || !is_free_to_move(grid, place, drop.direction)) continue;
    const Real liquid = block.surface->mass[drop.cell] - body_share(block, drop.cell);
    own.moving.push_back({drop, liquid, grid.type(grid.neighbour(place, drop.direction)) == CellType::sink});
  }
}

template <class Real>
void move_drops(FluidGrid<Real>& grid, LevelChanges<Real>& changes, BlockIndex b) {
  BlockChanges<Real>& own = changes.of(b);
  Block<Real>& block = grid.block(b);
  for (const MovingDrop<Real>& m : own.moving) {
    if (!m.leaves && first_into(grid, changes, grid.neighbour({b, m.drop.cell}, m.drop.direction)) != &m) continue;
    if (m.leaves) own.left += static_cast<double>(m.liquid);
    own.released += released_share(block, m.drop.cell);
    become_gas(block, m.drop.cell);
    own.types_changed = true;
    ++own.moves;
  }
  for (const BlockIndex from : grid.topology().neighbours(b)) {
    if (from == kNoBlock) continue;
    for (const MovingDrop<Real>& m : changes.of(from).moving) {
      const CellPlace place = grid.neighbour({from, m.drop.cell}, m.drop.direction);
      if (m.leaves || place.block != b || first_into(grid, changes, place) != &m) continue;
      if (own.fresh.has(place.cell)) continue;  // seen: over a periodic axis a block may be a neighbour twice
      block.type[static_cast<std::size_t>(place.cell)] = CellType::interface;
      own.arrivals.add(place.cell, {m.drop.moments, m.liquid});
      own.fresh.add(place.cell);
      own.types_changed = true;
    }
  }
}

template void choose_moving_drops<float>(const FluidGrid<float>&, LevelChanges<float>&, BlockIndex);
template void choose_moving_drops<double>(const FluidGrid<double>&, LevelChanges<double>&, BlockIndex);
template void move_drops<float>(FluidGrid<float>&, LevelChanges<float>&, BlockIndex);
template void move_drops<double>(FluidGrid<double>&, LevelChanges<double>&, BlockIndex);

}  // namespace lahar::lbm
