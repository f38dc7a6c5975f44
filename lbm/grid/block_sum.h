#pragma once
// The one way to sum over blocks: what each owned block contributes is found in parallel and added in Morton order. A
// block that contributes nothing changes no bit, so the sum does not depend on which dry blocks exist, nor on the
// number of threads. On several machines the terms of the owned blocks would be gathered here.
#include <vector>

#include "core/parallel.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Sum of term(block index) over the owned blocks.
template <class T, class Real, class Term>
T sum_over_blocks(const FluidGrid<Real>& grid, const Term& term, T zero = T{}) {
  constexpr std::size_t blocks_per_task = 16;
  const auto& owned = grid.owned();
  std::vector<T> terms(owned.size(), zero);
  parallel_for(0, owned.size(), blocks_per_task, [&](std::size_t k) { terms[k] = term(owned[k]); });
  T sum = zero;
  for (const T& t : terms) sum += t;
  return sum;
}

}  // namespace lahar::lbm
