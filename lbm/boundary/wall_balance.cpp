#include "lbm/boundary/wall_balance.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "lbm/grid/block_sum.h"

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

bool some_wall_moves_mass(const Domain& domain) {
  const auto& walls = domain.walls().all();
  return domain.placement() == WallPlacement::interpolated ||
         std::any_of(walls.begin(), walls.end(), [](const Wall& w) {
           return w.slip != WallSlip::no_slip || !w.velocity.isZero() || !w.angular_velocity.isZero();
         });
}

template <class Real>
void balance_walls(FluidGrid<Real>& grid, WallAccount& account) {
  const auto sum = [&](const auto& of_block) { return sum_over_blocks<double>(grid, of_block); };
  const double gained = sum([&](BlockIndex b) { return grid.block(b).walls.gained; });
  const double takers = sum([&](BlockIndex b) { return static_cast<double>(grid.block(b).walls.takers); });
  account.owed += gained;
  account.returned += std::abs(gained);
  if (takers == 0) return;
  const auto share = static_cast<Real>(-account.owed / takers);
  const auto& owned = grid.owned();
  parallel_for(0, owned.size(), 16, [&](std::size_t k) {
    Block<Real>& block = grid.block(owned[k]);
    block.walls.gained = block.walls.takers > 0 ? give(block, grid.domain().placement(), share) : 0;
  });
  account.owed += sum([&](BlockIndex b) { return grid.block(b).walls.gained; });
}

template void balance_walls<float>(FluidGrid<float>&, WallAccount&);
template void balance_walls<double>(FluidGrid<double>&, WallAccount&);

}  // namespace lahar::lbm
