#pragma once
// What lies next to a cell, and what a body has of it.
#include <algorithm>

#include "lbm/free_surface/covered_cells.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Whether a neighbour of a cell is of a kind.
template <class Real, class Kind>
bool touches(const FluidGrid<Real>& grid, CellPlace place, const Kind& kind) {
  const auto& around = grid.around(place.block);
  for (int i = 1; i < D3Q19::q; ++i) {
    const Block<Real>* block = around[kNeighbours.slot(i, place.cell)];
    if (kind(block ? block->type[kNeighbours.cell(i, place.cell)] : CellType::gas)) return true;
  }
  return false;
}

template <class Real>
bool touches_gas(const FluidGrid<Real>& grid, CellPlace place) {
  return touches(grid, place, [](CellType t) { return t == CellType::gas || t == CellType::sink; });
}

/// Liquid that is not the inside of a body.
template <class Real>
bool touches_liquid(const FluidGrid<Real>& grid, CellPlace place) {
  const auto& around = grid.around(place.block);
  for (int i = 1; i < D3Q19::q; ++i) {
    const Block<Real>* block = around[kNeighbours.slot(i, place.cell)];
    const int cell = kNeighbours.cell(i, place.cell);
    if (block && block->type[static_cast<std::size_t>(cell)] == CellType::liquid && !is_covered(*block, cell))
      return true;
  }
  return false;
}

/// What an interface cell without liquid holds of bodies, cells.
template <class Real>
Real body_share(const Block<Real>& block, int cell) {
  return block.body && !block.body->fills_with_level ? block.body->solid_fraction[cell] : Real(0);
}

/// What an interface cell gives up of bodies when it empties, cells.
template <class Real>
double released_share(const Block<Real>& block, int cell) {
  return block.body && block.body->fills_with_level ? static_cast<double>(block.body->solid_fraction[cell]) : 0.0;
}

/// Liquid of an interface cell, lu; none if it owes.
template <class Real>
Real liquid_of(const Block<Real>& block, int cell) {
  return std::max(Real(0), block.surface->mass[cell] - body_share(block, cell));
}

}  // namespace lahar::lbm
