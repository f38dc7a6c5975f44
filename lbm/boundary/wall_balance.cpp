#include "lbm/boundary/wall_balance.h"

#include <cmath>

#include "core/parallel.h"

namespace lahar::lbm {

namespace {

/// Adds to the rest populations of a block's liquid cells at such walls; returns what arrived there.
template <class Real>
double give(Block<Real>& block, WallPlacement placement, Real share) {
  double arrived = 0;
  for (const WallCell& wall : block.walls.cells) {
    if (block.type[wall.cell] != CellType::liquid || !moves_mass(wall, placement)) continue;
    Real& rest = block.f(0)[wall.cell];
    const Real before = rest;
    rest += share;
    arrived += static_cast<double>(rest) - static_cast<double>(before);
  }
  return arrived;
}

}  // namespace

template <class Real>
void balance_walls(FluidGrid<Real>& grid, WallAccount& account) {
  const auto& active = grid.active();
  const auto sum = [&](const auto& of_block) { return ordered_sum<double>(active.size(), of_block, 16); };
  const double gained = sum([&](std::size_t k) { return grid.block(active[k]).walls.gained; });
  const double takers = sum([&](std::size_t k) { return static_cast<double>(grid.block(active[k]).walls.takers); });
  account.owed += gained;
  account.returned += std::abs(gained);
  if (takers == 0) return;
  const auto share = static_cast<Real>(-account.owed / takers);
  parallel_for(0, active.size(), 16, [&](std::size_t k) {
    Block<Real>& block = grid.block(active[k]);
    block.walls.gained = block.walls.takers > 0 ? give(block, grid.domain().placement(), share) : 0;
  });
  account.owed += sum([&](std::size_t k) { return grid.block(active[k]).walls.gained; });
}

template void balance_walls<float>(FluidGrid<float>&, WallAccount&);
template void balance_walls<double>(FluidGrid<double>&, WallAccount&);

}  // namespace lahar::lbm
