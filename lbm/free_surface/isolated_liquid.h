#pragma once
// Liquid that has no cell, or a debt that nobody can pay.
//
// Of bodies that cross the surface, and of cells that they cover, it is paid at once, in small doses alike, to
// interface cells of its block that no body covers, and what these have no room for to those of the blocks around: mass
// has the velocity of the cell that gets it, so that the nearer that is the less momentum comes from nowhere
// (docs/decisions/0112).
//
// What is left of that, and what found no taker when its cell converted, waits in a pool and is paid to all interface
// cells. What each block can take is laid out in Morton order along a line; the pool fills a stretch of it, closed to a
// ring, that begins at another place in every round: multiples of the golden ratio, so that all cells get the same in
// the long run without anybody remembering who was last (Weyl 1916).
#include <cmath>
#include <cstdint>

#include "lbm/free_surface/block_changes.h"
#include "lbm/free_surface/conversion.h"

namespace lahar::lbm {

/// Liquid, lu, for which there is no cell; below 0 a void.
inline void send_to_pool(double mass, LiquidAccount& account) {
  account.pool += mass, account.pooled_total += std::abs(mass);
}

/// Pays isolated liquid, lu by block index (below 0: debts), to interface cells of its block and of those around, and
/// books it; what is left goes to the pool. Lists of interface cells must be up to date.
template <class Real>
void pay_nearby(FluidGrid<Real>& grid, const std::vector<double>& liquid, LiquidAccount& account);

/// Pays from `pool`, lu, to the interface cells of `blocks` (in Morton order, with surface); returns what was paid, as
/// the cells stored it. Their lists of interface cells must be up to date.
template <class Real>
double pay_isolated_liquid(FluidGrid<Real>& grid, const std::vector<BlockIndex>& blocks, double pool,
                           std::uint64_t round);

extern template void pay_nearby<float>(FluidGrid<float>&, const std::vector<double>&, LiquidAccount&);
extern template void pay_nearby<double>(FluidGrid<double>&, const std::vector<double>&, LiquidAccount&);
extern template double pay_isolated_liquid<float>(FluidGrid<float>&, const std::vector<BlockIndex>&, double,
                                                  std::uint64_t);
extern template double pay_isolated_liquid<double>(FluidGrid<double>&, const std::vector<BlockIndex>&, double,
                                                   std::uint64_t);

}  // namespace lahar::lbm
