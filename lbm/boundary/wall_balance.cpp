#include "lbm/boundary/wall_balance.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "lbm/boundary/wall_traction.h"
#include "lbm/grid/block_sum.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

namespace {

/// Whether a wall cell pays for what walls add.
template <class Real>
bool takes_back(const Block<Real>& block, const WallCell& wall, WallPlacement placement) {
  return block.type[wall.cell] == CellType::liquid && moves_mass(wall, placement);
}

/// Adds to the rest populations of a block's liquid cells at such walls; returns what arrived there.
template <class Real>
double give(Block<Real>& block, WallPlacement placement, Real share) {
  double arrived = 0;
  for (const WallCell& wall : block.walls.cells) {
    if (!takes_back(block, wall, placement)) continue;
    Real& rest = block.f(0)[wall.cell];
    const Real before = rest;
    rest += share;
    if (block.surface) block.surface->density[wall.cell] += share;
    arrived += static_cast<double>(rest) - static_cast<double>(before);
  }
  return arrived;
}

/// 0 in gas, 1 in liquid.
template <class Real>
double fill_level(const FluidGrid<Real>& grid, CellPlace place) {
  const CellType type = grid.type(place);
  if (type != CellType::interface) return type == CellType::liquid ? 1 : 0;
  return static_cast<double>(grid.block(place.block).surface->fill_level[place.cell]);
}

template <class Real>
bool has_liquid_around(const FluidGrid<Real>& grid, CellPlace place) {
  for (int i = 1; i < D3Q19::q; ++i)
    if (grid.type(grid.neighbour(place, i)) == CellType::liquid) return true;
  return false;
}

/// Mass that an interface cell gets over its links into a wall in steps.
template <class Real>
double gain_through_steps(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity) {
  const auto m = outgoing_moments(grid, place, parity);
  const Vec3 slip = slip_half_a_step_on(grid, place, wall, parity, m);
  const Stretch stretch = stretch_along(grid, place, parity, m, slip);
  const auto no_wall = [&](int i) { return grid.type(grid.neighbour(place, i)) != CellType::wall; };
  const int upstream = direction_along(Vec3(-slip), no_wall);
  const double own = fill_level(grid, place),
               before = upstream == 0 ? own : fill_level(grid, grid.neighbour(place, upstream));
  const WallLinks& walls = grid.block(place.block).walls;
  double gain = 0;
  for (int k = 0; k < wall.links; ++k) {
    const int i = walls.directions[static_cast<std::size_t>(wall.first_link + k)];
    const double out = slip.dot(Vec3(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2])) + stretch.half_way(i);
    gain -= 6 * D3Q19::w(i) * out * (out > 0 ? own : before);
  }
  return gain;
}

/// The same of a block's interface cells that have liquid around: a lone drop would be lost in the steps.
template <class Real>
double gain_of_block(FluidGrid<Real>& grid, BlockIndex b, Parity parity) {
  Block<Real>& block = grid.block(b);
  if (!block.surface) return 0;
  double gained = 0;
  for (const std::uint16_t entry : block.walls.others) {
    const WallCell& wall = block.walls.cells[entry];
    const CellPlace place{b, wall.cell};
    if (block.type[wall.cell] != CellType::interface || !slips_along_steps(wall)) continue;
    if (!has_liquid_around(grid, place)) continue;
    Real& mass = block.surface->mass[wall.cell];
    const Real before = mass;
    mass += static_cast<Real>(gain_through_steps(grid, place, wall, parity));
    gained += static_cast<double>(mass) - static_cast<double>(before);
  }
  return gained;
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
void exchange_through_steps(FluidGrid<Real>& grid, Parity parity, WallAccount& account) {
  const auto& walls = grid.domain().walls().all();
  if (std::none_of(walls.begin(), walls.end(), [](const Wall& w) { return w.slip != WallSlip::no_slip; })) return;
  const int payers = sum_over_blocks<int>(grid, [&](BlockIndex b) {
    const Block<Real>& block = grid.block(b);
    return static_cast<int>(std::any_of(block.walls.others.begin(), block.walls.others.end(), [&](std::uint16_t entry) {
      return takes_back(block, block.walls.cells[entry], grid.domain().placement());
    }));
  });
  if (payers == 0) return;
  const double gained = sum_over_blocks<double>(grid, [&](BlockIndex b) { return gain_of_block(grid, b, parity); });
  account.owed += gained;
  account.returned += std::abs(gained);
}

template void exchange_through_steps<float>(FluidGrid<float>&, Parity, WallAccount&);
template void exchange_through_steps<double>(FluidGrid<double>&, Parity, WallAccount&);

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
