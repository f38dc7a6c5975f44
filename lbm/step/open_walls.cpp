// A wall that is taken away between two steps, as a gate.
#include <algorithm>

#include "lbm/boundary/wall_reflection.h"
#include "lbm/free_surface/refilling.h"
#include "lbm/free_surface/surface_exchange.h"
#include "lbm/free_surface/touching.h"
#include "lbm/step/fluid.h"

namespace lahar::lbm {

/// Where the wall stood is gas. Liquid cells beside it become full interface cells, which let nothing out that they did
/// not hold: the ledger of the liquid stays. What the wall has sent back is set anew from gas before the coming step.
template <class Real>
bool Fluid<Real>::open_walls_by(double time) {
  FluidGrid<Real>& grid = level_.grid;
  const auto& walls = grid.domain().walls().all();
  if (std::none_of(walls.begin(), walls.end(), [&](const Wall& w) { return !w.open && w.opens_at <= time; }))
    return false;
  const std::vector<BlockIndex> changed = grid.open_walls_by(time);
  std::vector<CellPlace> exposed;
  for (const BlockIndex b : changed)
    for (int n = 0; n < kBlockCells; ++n)
      if (grid.type({b, n}) == CellType::liquid && touches_gas(grid, {b, n})) exposed.push_back({b, n});
  for (const CellPlace& place : exposed) {
    grid.require_surface(place.block);
    grid.block(place.block).type[static_cast<std::size_t>(place.cell)] = CellType::interface;
    expose_cell(grid, place, level_.parity());
  }
  require_neighbours(exposed);
  for (const BlockIndex b : changed) {
    grid.relist(b);
    if (grid.block(b).surface) note_densities(grid, b, level_.parity());
    if (grid.has_walls(b)) reflect_at_walls(grid, b, level_.parity(), wall_physics(level_.parameters), nullptr);
  }
  for (Inflow<Real>& inflow : inflows_) inflow.find_columns(grid.domain());
  return true;
}

template bool Fluid<float>::open_walls_by(double);
template bool Fluid<double>::open_walls_by(double);

}  // namespace lahar::lbm
