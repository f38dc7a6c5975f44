#include "lbm/boundary/wall_balance.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/parallel.h"
#include "lbm/boundary/wall_traction.h"
#include "lbm/grid/block_sum.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

namespace {

/// Adds to the rest populations of those liquid cells at a block's walls that `pays` chooses; returns what arrived.
template <class Real, class Pays>
double give(Block<Real>& block, Real share, const Pays& pays) {
  double arrived = 0;
  for (const WallCell& wall : block.walls.cells) {
    if (block.type[wall.cell] != CellType::liquid || !pays(wall)) continue;
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

/// Mass that an interface cell gets over its links into a wall in steps. Those that a mirror leads over a bend count
/// towards another interface cell; what goes to and fro between it and liquid is that of mirrors (slip_wall.h).
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
  const auto counts = [&](const WallCell& entry, int i) {
    return !is_mirror(entry) ||
           grid.type(grid.neighbour(place, mirror_link(i, normal_axis(entry)).along)) == CellType::interface;
  };
  double gain = 0;
  const std::span entries(&wall, walls.cells.data() + walls.cells.size());
  for (const WallCell& entry : entries) {
    if (entry.cell != wall.cell || entry.wall != wall.wall) break;
    for (int k = 0; k < entry.links; ++k) {
      const int i = walls.directions[static_cast<std::size_t>(entry.first_link + k)];
      if (!counts(entry, i)) continue;
      const double out = slip.dot(Vec3(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2])) + stretch.half_way(i);
      gain -= 6 * D3Q19::w(i) * out * (out > 0 ? own : before);
    }
  }
  return gain;
}

/// Visits the interface cells of a block that are on steps: visit(place, wall cell, mass).
template <class Real, class Visit>
void for_cells_on_steps(FluidGrid<Real>& grid, BlockIndex b, const Visit& visit) {
  Block<Real>& block = grid.block(b);
  if (!block.surface) return;
  for (const std::uint16_t entry : block.walls.others) {
    const WallCell& wall = block.walls.cells[entry];
    const CellPlace place{b, wall.cell};
    if (block.type[wall.cell] == CellType::interface && slips_along_steps(wall))
      visit(place, wall, block.surface->mass[wall.cell]);
  }
}

/// Of the wet cells at steps along which the liquid slips.
struct AtSteps {
  double gained = 0;  ///< mass that interface cells got over the steps, lu
  double levels = 0;  ///< sum of the fill levels

  AtSteps& operator+=(const AtSteps& more) {
    gained += more.gained, levels += more.levels;
    return *this;
  }
};

/// Adds to `mass`; returns what arrived.
template <class Real>
double add(double more, Real& mass) {
  const Real before = mass;
  mass += static_cast<Real>(more);
  return static_cast<double>(mass) - static_cast<double>(before);
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
  const AtSteps all = sum_over_blocks<AtSteps>(grid, [&](BlockIndex b) {
    const Block<Real>& block = grid.block(b);
    AtSteps sum;
    sum.levels = static_cast<double>(
        std::count_if(block.walls.others.begin(), block.walls.others.end(), [&](std::uint16_t entry) {
          const WallCell& wall = block.walls.cells[entry];
          return block.type[wall.cell] == CellType::liquid && slips_along_steps(wall);
        }));
    for_cells_on_steps(grid, b, [&](CellPlace place, const WallCell& wall, Real& mass) {
      sum.levels += fill_level(grid, place);
      if (has_liquid_around(grid, place))  // a lone drop would be lost in the steps
        sum.gained += add(gain_through_steps(grid, place, wall, parity), mass);
    });
    return sum;
  });
  account.owed += all.gained;
  account.returned += std::abs(all.gained);
  if (all.levels == 0) return;
  const double share = -account.owed / all.levels;
  account.owed += sum_over_blocks<double>(grid, [&](BlockIndex b) {
    double sum = give(grid.block(b), static_cast<Real>(share), slips_along_steps);
    for_cells_on_steps(grid, b, [&](CellPlace place, const WallCell&, Real& mass) {
      sum += add(share * fill_level(grid, place), mass);
    });
    return sum;
  });
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
    const auto pays = [&](const WallCell& wall) { return moves_mass(wall, grid.domain().placement()); };
    block.walls.gained = block.walls.takers > 0 ? give(block, share, pays) : 0;
  });
  account.owed += sum([&](BlockIndex b) { return grid.block(b).walls.gained; });
}

template void balance_walls<float>(FluidGrid<float>&, WallAccount&);
template void balance_walls<double>(FluidGrid<double>&, WallAccount&);

}  // namespace lahar::lbm
