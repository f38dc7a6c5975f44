#pragma once
// Cells that a body takes over whole: what is wet in them is the mixture that carries the body through the liquid and
// moves as the body does, no liquid (docs/decisions/0041). Who writes the body fields says which they are: with
// BodyWeighting::wall_distance those whose centre is inside a body; the other weightings leave every cell some flow of
// its own.
#include "lbm/grid/block.h"

namespace lahar::lbm {

template <class Real>
[[gnu::always_inline]] inline bool is_covered(const Block<Real>& block, int cell) {
  const auto n = static_cast<unsigned>(cell);
  return block.body && block.body->covered[n / kBlockWidth] >> n % kBlockWidth & 1;
}

}  // namespace lahar::lbm
