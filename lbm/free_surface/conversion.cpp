#include "lbm/free_surface/conversion.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/parallel.h"
#include "lbm/collision/equilibrium.h"
#include "lbm/free_surface/surface_exchange.h"
#include "lbm/free_surface/touching.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

namespace {

constexpr double kPoolDose = 0.02;        ///< largest payment of the pool to one cell in a step
constexpr std::uint64_t kVoidsEvery = 8;  ///< steps between looks for voids that are cut off from the gas
constexpr double kPoolIdle = 1e-5;        ///< a smaller pool waits: payments would drown in rounding

template <class Real>
Real liquid_of(const FluidGrid<Real>& grid, CellPlace place) {
  return liquid_of(grid.block(place.block), place.cell);
}

/// Takes a share of the liquid of interface cells and adds it to `account`.
template <class Real>
void take_liquid(FluidGrid<Real>& grid, std::span<const CellPlace> cells, Real share, Real& account) {
  for (const CellPlace& p : cells) {
    Real& mass = grid.block(p.block).surface->mass[p.cell];
    const Real before = mass;
    mass -= share * liquid_of(grid, p);
    account += before - mass;
  }
}

/// A void that is cut off from the gas: an interface cell that is not full although none of its neighbours is gas. No
/// link tells them the gas pressure any more, so that they would stand half empty in water under any pressure. They
/// take liquid from their liquid neighbours as long as those are above the gas pressure: at most what would bring them
/// down to it half-way, and what is missing flows in. Only cells under pressure are touched, and mass is moved, not
/// made.
template <class Real>
void close_void(FluidGrid<Real>& grid, CellPlace place, Parity parity) {
  SurfaceFields<Real>& surface = *grid.block(place.block).surface;
  CellPlace liquids[D3Q19::q];
  Real above[D3Q19::q], sum = 0;
  int n = 0;
  for (int i = 1; i < D3Q19::q; ++i) {
    const CellPlace next = grid.neighbour(place, i);
    if (grid.type(next) != CellType::liquid) continue;
    const Real drho = outgoing_moments(grid, next, parity).drho;
    if (drho <= 0) continue;
    liquids[n] = next, above[n] = drho, sum += drho;
    ++n;
  }
  const Real missing = Real(1) + surface.density[place.cell] - surface.mass[place.cell];
  if (n == 0 || missing <= 0) return;
  const Real share = std::min(Real(0.5), missing / sum);
  for (int k = 0; k < n; ++k) {
    Real& rest = grid.block(liquids[k].block).f(0)[liquids[k].cell];
    const Real before = rest;
    rest -= share * above[k];
    surface.mass[place.cell] += before - rest;
  }
}

}  // namespace

template <class Real>
void CellConversion<Real>::run(FluidGrid<Real>& grid, Parity parity, LiquidAccount& account) {
  for (const double left : left_) account.outflow += left;
  fill_cells(grid, parity);
  empty_cells(grid, parity);
  move_drops(grid, parity, account);
  distribute(grid, account);
  pay_pool(grid, account);
  if (round_ % kVoidsEvery == 0) close_voids(grid, parity);
  relist_touched(grid, parity);
}

template <class Real>
void CellConversion<Real>::relist_touched(FluidGrid<Real>& grid, Parity parity) {
  parallel_for(0, touched_.size(), 8, [&](std::size_t k) { grid.list_cells(touched_[k]); });
  for (const BlockIndex b : new_surfaces_) note_densities(grid, b, parity);
  new_surfaces_.clear();
  for (const BlockIndex b : touched_) {
    grid.release_unused_surface(b);
    fresh_[static_cast<std::size_t>(b)].clear();
    is_touched_[static_cast<std::size_t>(b)] = 0;
  }
  touched_.clear();
}

/// They are looked for in parallel, and closed in the order of blocks and cells.
template <class Real>
void CellConversion<Real>::close_voids(FluidGrid<Real>& grid, Parity parity) {
  voids_.resize(with_surface_.size());
  parallel_for(0, with_surface_.size(), 16, [&](std::size_t k) {
    const BlockIndex b = with_surface_[k];
    const Block<Real>& block = grid.block(b);
    voids_[k].clear();
    for (int c = 0; c < block.surface->count; ++c) {
      const auto cell = block.surface->cells[static_cast<std::size_t>(c)];
      if (block.type[cell] == CellType::interface && !block.at_rim[cell] && !touches_gas(grid, {b, cell}))
        voids_[k].push_back(cell);
    }
  });
  for (std::size_t k = 0; k < with_surface_.size(); ++k)
    for (const auto cell : voids_[k]) close_void(grid, {with_surface_[k], cell}, parity);
}

template <class Real>
void CellConversion<Real>::wet(FluidGrid<Real>& grid, CellPlace place, Parity parity,
                               const CellMoments<Real>& moments) {
  set_interface(grid, place, parity, moments, Real(0));
  relist_touched(grid, parity);
}

template <class Real>
void CellConversion<Real>::begin(const FluidGrid<Real>& grid) {
  ++round_;
  for (const BlockIndex b : with_surface_) flagged_[static_cast<std::size_t>(b)].clear();  // also if the block is gone
  flagged_.resize(grid.topology().capacity());
  with_surface_.clear();
  for (const BlockIndex b : grid.active())
    if (grid.has_surface(b)) with_surface_.push_back(b);
  left_.assign(grid.active().size(), 0);
}

template <class Real>
void CellConversion<Real>::flag(FluidGrid<Real>& grid, std::size_t k, Parity parity, const SweepNote& note) {
  const BlockIndex b = grid.active()[k];
  left_[k] =
      flag_conversions(grid, b, parity, round_, std::sqrt(note.speed_square), flagged_[static_cast<std::size_t>(b)]);
}

template <class Real>
void CellConversion<Real>::touch(BlockIndex b) {
  const auto at = static_cast<std::size_t>(b);
  if (at >= is_touched_.size()) {
    is_touched_.resize(at + 64, 0);
    fresh_.resize(at + 64);
  }
  if (is_touched_[at]) return;
  is_touched_[at] = 1;
  touched_.push_back(b);
}

template <class Real>
bool CellConversion<Real>::is_fresh(CellPlace p) const {
  const auto at = static_cast<std::size_t>(p.block);
  if (at >= fresh_.size()) return false;
  return std::find(fresh_[at].begin(), fresh_[at].end(), p.cell) != fresh_[at].end();
}

template <class Real>
void CellConversion<Real>::fill_cells(FluidGrid<Real>& grid, Parity parity) {
  excess_.clear();
  opened_.clear();
  for (const BlockIndex b : with_surface_)
    for (const auto cell : flagged_[static_cast<std::size_t>(b)].filled) {
      const CellPlace place{b, cell};
      Block<Real>& block = grid.block(place.block);
      const Real rho = Real(1) + block.surface->density[cell];
      excess_.push_back({place, block.surface->mass[cell] - rho});
      block.type[cell] = CellType::liquid;
      block.surface->fill_level[cell] = Real(1);
      block.surface->mass[cell] = 0;
      touch(place.block);
      wet_neighbours(grid, place);
    }
  // What they start with hangs on cells that were wet before alone.
  parallel_for(0, opened_.size(), 16, [&](std::size_t k) {
    settle_interface(grid, opened_[k], parity, mean_around(grid, opened_[k], parity), Real(0));
  });
  for (const CellPlace place : opened_) fill_covered(grid, place);
}

/// A cell that a body covers is full or gas (covered_cells.h). The neighbours that get what it holds when it empties
/// are those that pay for it when it opens, as far as their liquid goes: paid for by the body's whole waterline it
/// would pump liquid up, each time that it opens and empties, to where it stands (docs/decisions/0045).
template <class Real>
void CellConversion<Real>::fill_covered(FluidGrid<Real>& grid, CellPlace place) const {
  Block<Real>& block = grid.block(place.block);
  if (!is_covered(block, place.cell)) return;
  CellPlace open[D3Q19::q];
  std::size_t n = 0;
  Real means = 0;
  for (int i = 1; i < D3Q19::q; ++i) {
    const CellPlace next = grid.neighbour(place, i);
    if (grid.type(next) != CellType::interface || is_covered(grid.block(next.block), next.cell)) continue;
    open[n++] = next, means += liquid_of(grid, next);
  }
  const auto cell = static_cast<std::size_t>(place.cell);
  SurfaceFields<Real>& surface = *block.surface;
  const Real whole = Real(1) + surface.density[cell], missing = whole - surface.mass[cell];
  if (means <= 0 || missing <= 0) return;
  take_liquid(grid, std::span<const CellPlace>(open, n), std::min(Real(1), missing / means), surface.mass[cell]);
  surface.fill_level[cell] = std::clamp(surface.mass[cell] / whole, Real(0), Real(1));
}

/// Gas next to a new liquid cell becomes interface; a neighbour that was about to empty stays.
template <class Real>
void CellConversion<Real>::wet_neighbours(FluidGrid<Real>& grid, CellPlace place) {
  for (int i = 1; i < D3Q19::q; ++i) {
    const CellPlace next = grid.neighbour(place, i);
    const CellType t = grid.type(next);
    if (t == CellType::gas) {
      open_interface(grid, next);
      opened_.push_back(next);
    }
    if (t == CellType::interface && static_cast<std::size_t>(next.block) < flagged_.size())
      std::erase(flagged_[static_cast<std::size_t>(next.block)].emptied, next.cell);
  }
}

/// Mean density and velocity of the wet cells around, but those that are new.
template <class Real>
CellMoments<Real> CellConversion<Real>::mean_around(FluidGrid<Real>& grid, CellPlace place, Parity parity) const {
  CellMoments<Real> mean;
  int sources = 0;
  for (int i = 1; i < D3Q19::q; ++i) {
    const CellPlace next = grid.neighbour(place, i);
    if (!is_wet(grid.type(next)) || is_fresh(next)) continue;
    const auto m = outgoing_moments(grid, next, parity);
    mean.drho += m.drho;
    for (int k = 0; k < 3; ++k) mean.u[k] += m.u[k];
    ++sources;
  }
  if (sources > 0) {
    mean.drho /= static_cast<Real>(sources);
    for (Real& u : mean.u) u /= static_cast<Real>(sources);
  }
  return mean;
}

/// A gas cell becomes interface with some liquid, in the equilibrium of given moments.
template <class Real>
void CellConversion<Real>::set_interface(FluidGrid<Real>& grid, CellPlace place, Parity parity,
                                         const CellMoments<Real>& mean, Real liquid) {
  open_interface(grid, place);
  settle_interface(grid, place, parity, mean, liquid);
}

/// The fields of a block's surface; the coming exchange looks at densities that no sweep has written into new ones.
template <class Real>
SurfaceFields<Real>& CellConversion<Real>::require_surface(FluidGrid<Real>& grid, BlockIndex b) {
  if (!grid.block(b).surface) new_surfaces_.push_back(b);
  return grid.require_surface(b);
}

/// Type and place in the blocks.
template <class Real>
void CellConversion<Real>::open_interface(FluidGrid<Real>& grid, CellPlace place) {
  grid.require_neighbours(place);
  require_surface(grid, place.block);
  grid.block(place.block).type[static_cast<std::size_t>(place.cell)] = CellType::interface;
  touch(place.block);
  fresh_[static_cast<std::size_t>(place.block)].push_back(static_cast<std::uint16_t>(place.cell));
}

/// Numbers of the cell alone.
template <class Real>
void CellConversion<Real>::settle_interface(FluidGrid<Real>& grid, CellPlace place, Parity parity,
                                            const CellMoments<Real>& mean, Real liquid) const {
  Block<Real>& block = grid.block(place.block);
  SurfaceFields<Real>& surface = *block.surface;
  const auto cell = static_cast<std::size_t>(place.cell);
  surface.mass[cell] = body_share(block, place.cell) + liquid;
  surface.density[cell] = mean.drho;
  surface.fill_level[cell] = std::clamp(surface.mass[cell] / (Real(1) + mean.drho), Real(0), Real(1));
  // Outgoing populations of the new cell; what comes in from wet neighbours is there already, what comes from gas is
  // rebuilt before the next step, what comes from walls is set here.
  block.f(0)[cell] = equilibrium(0, mean.drho, mean.u[0], mean.u[1], mean.u[2]);
  for (int a = 1; a < D3Q19::q; a += 2) {
    const auto pair = grid.access(place, a, parity);
    const Real fa = equilibrium(a, mean.drho, mean.u[0], mean.u[1], mean.u[2]);
    const Real fb = equilibrium(a + 1, mean.drho, mean.u[0], mean.u[1], mean.u[2]);
    *pair.outgoing_a = fa;
    *pair.outgoing_b = fb;
    if (grid.type(grid.neighbour(place, a)) == CellType::wall) *pair.incoming_b = fb;
    if (grid.type(grid.neighbour(place, a + 1)) == CellType::wall) *pair.incoming_a = fa;
  }
}

template <class Real>
void CellConversion<Real>::empty_cells(FluidGrid<Real>& grid, Parity parity) {
  for (const BlockIndex b : with_surface_)
    for (const auto cell : flagged_[static_cast<std::size_t>(b)].emptied) {
      const CellPlace place{b, cell};
      Block<Real>& block = grid.block(place.block);
      excess_.push_back({place, block.surface->mass[cell] - body_share(block, cell)});
      block.type[cell] = CellType::gas;
      block.surface->fill_level[cell] = Real(0);
      block.surface->mass[cell] = 0;
      touch(place.block);
      for (int i = 1; i < D3Q19::q; ++i) {
        const CellPlace next = grid.neighbour(place, i);
        if (grid.type(next) == CellType::liquid) expose_liquid(grid, next, parity);
      }
    }
}

/// Spray moves on by a cell; through an open face it leaves. Whether a drop is free to move is settled for all before
/// the first one moves: neighbours that move together do not stand in each other's way. Of two that meet in one cell
/// the later one waits.
template <class Real>
void CellConversion<Real>::move_drops(FluidGrid<Real>& grid, Parity parity, LiquidAccount& account) {
  for (const BlockIndex b : with_surface_)
    std::erase_if(flagged_[static_cast<std::size_t>(b)].drops, [&](const Drop<Real>& drop) {
      const CellPlace place{b, drop.cell};
      return grid.type(place) != CellType::interface || !is_free_to_move(grid, place, drop.direction);
    });
  for (const BlockIndex b : with_surface_)
    for (const Drop<Real>& drop : flagged_[static_cast<std::size_t>(b)].drops)
      move_drop(grid, {b, drop.cell}, drop, parity, account);
}

template <class Real>
void CellConversion<Real>::move_drop(FluidGrid<Real>& grid, CellPlace place, const Drop<Real>& drop, Parity parity,
                                     LiquidAccount& account) {
  const CellPlace next = grid.neighbour(place, drop.direction);
  const CellType there = grid.type(next);
  if (there == CellType::interface) return;
  Block<Real>& block = grid.block(place.block);
  const Real liquid = block.surface->mass[drop.cell] - body_share(block, drop.cell);
  if (there == CellType::sink)
    account.outflow += static_cast<double>(liquid);
  else
    set_interface(grid, next, parity, drop.moments, liquid);
  block.type[drop.cell] = CellType::gas;
  block.surface->fill_level[drop.cell] = Real(0);
  block.surface->mass[drop.cell] = 0;
  touch(place.block);
  ++account.drop_moves;
}

/// A liquid cell next to new gas becomes a full interface cell.
template <class Real>
void CellConversion<Real>::expose_liquid(FluidGrid<Real>& grid, CellPlace place, Parity parity) {
  const auto m = outgoing_moments(grid, place, parity);
  Block<Real>& block = grid.block(place.block);
  SurfaceFields<Real>& surface = require_surface(grid, place.block);
  const auto cell = static_cast<std::size_t>(place.cell);
  block.type[cell] = CellType::interface;
  surface.mass[cell] = Real(1) + m.drho;
  surface.density[cell] = m.drho;
  surface.fill_level[cell] = Real(1);
  grid.require_neighbours(place);
  touch(place.block);
}

/// What a cell was left over goes to its interface neighbours in equal parts. What it owes they pay in proportion to
/// the liquid that they have, and not beyond it: a debt in equal parts would fall on cells that are as good as empty
/// and make them owe more than a cell may before it is given up. What they cannot pay liquid neighbours do, or the
/// pool.
template <class Real>
void CellConversion<Real>::distribute(FluidGrid<Real>& grid, LiquidAccount& account) {
  for (const Excess& e : excess_) {
    CellPlace open[D3Q19::q], covered[D3Q19::q], liquids[D3Q19::q];
    std::size_t n_open = 0, n_covered = 0;
    int n_liquid = 0;
    for (int i = 1; i < D3Q19::q; ++i) {
      const CellPlace next = grid.neighbour(e.place, i);
      const CellType t = grid.type(next);
      if (t == CellType::liquid) liquids[n_liquid++] = next;
      if (t != CellType::interface) continue;
      if (is_covered(grid.block(next.block), next.cell))
        covered[n_covered++] = next;
      else
        open[n_open++] = next;
    }
    // What a body covers holds no liquid of its own.
    const std::span<const CellPlace> interfaces = n_open > 0 ? std::span(open, n_open) : std::span(covered, n_covered);
    const auto mass_of = [&](CellPlace p) -> Real& { return grid.block(p.block).surface->mass[p.cell]; };
    Real means = 0;
    for (const CellPlace& p : interfaces) means += liquid_of(grid, p);
    Real rest = e.mass;
    if (rest >= 0 && !interfaces.empty()) {
      for (const CellPlace& p : interfaces) mass_of(p) += e.mass / static_cast<Real>(interfaces.size());
      continue;
    }
    if (rest < 0 && means > 0) {
      const Real share = std::min(Real(1), -rest / means);
      take_liquid(grid, interfaces, share, rest);
      if (share < 1) {  // what is left is rounding: it stays with one of them
        mass_of(interfaces.front()) += rest;
        continue;
      }
    }
    if (n_liquid > 0) {
      for (int k = 0; k < n_liquid; ++k)
        grid.block(liquids[k].block).f(0)[liquids[k].cell] += rest / static_cast<Real>(n_liquid);
    } else {
      account.pool += static_cast<double>(rest);
      account.pooled_total += std::abs(static_cast<double>(rest));
    }
  }
}

/// Pays the pool back to interface cells in small doses, going round the blocks.
template <class Real>
void CellConversion<Real>::pay_pool(FluidGrid<Real>& grid, LiquidAccount& account) {
  const auto& active = grid.active();
  for (std::size_t k = 0; k < active.size() && std::abs(account.pool) > kPoolIdle; ++k) {
    pool_cursor_ = (pool_cursor_ + 1) % active.size();
    SurfaceFields<Real>* surface = grid.block(active[pool_cursor_]).surface;
    if (!surface) continue;
    for (int c = 0; c < surface->count && std::abs(account.pool) > kPoolIdle; ++c) {
      const auto cell = surface->cells[static_cast<std::size_t>(c)];
      if (grid.block(active[pool_cursor_]).type[cell] != CellType::interface) continue;
      const double has = static_cast<double>(liquid_of(grid, {active[pool_cursor_], cell}));
      const auto dose = static_cast<Real>(std::clamp(account.pool, -std::min(kPoolDose, has), kPoolDose));
      const Real before = surface->mass[cell];
      surface->mass[cell] += dose;
      account.pool -= static_cast<double>(surface->mass[cell]) - static_cast<double>(before);
    }
  }
}

template class CellConversion<float>;
template class CellConversion<double>;

}  // namespace lahar::lbm
