#pragma once
// Cells that a body takes over whole: what is wet in them is the mixture that carries the body through the liquid and
// moves as the body does, no liquid (docs/decisions/0041).
#include "lbm/grid/block.h"

namespace lahar::lbm {

/// Resistance from which a cell counts as covered: with BodyWeighting::wall_distance, where a cell's centre is inside a
/// body. The other weightings stay far below; they leave every cell some flow of its own.
inline constexpr double kCoveredResistance = 1e6;

template <class Real>
[[gnu::always_inline]] inline bool is_covered(const Block<Real>& block, int cell) {
  return block.body && block.body->resistance[cell] >= static_cast<Real>(kCoveredResistance);
}

}  // namespace lahar::lbm
