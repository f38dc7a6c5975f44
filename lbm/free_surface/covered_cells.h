#pragma once
// Cells that a body takes over whole: what is wet in them is the mixture that carries the body through the liquid and
// moves as the body does, no liquid (docs/decisions/0041). Who writes the body fields says which they are: by the
// distance from the wall (wall_distance, inertial) those whose centre is inside a grain; mapped wires and the other
// weightings leave every cell some flow of its own.
#include <algorithm>
#include <array>

#include "lbm/grid/block.h"

namespace lahar::lbm {

template <class Real>
[[gnu::always_inline]] inline bool is_covered(const Block<Real>& block, int cell) {
  const auto n = static_cast<unsigned>(cell);
  return block.body && block.body->covered[n / kBlockWidth] >> n % kBlockWidth & 1;
}

/// Velocity of the bodies of a cell, lu; 0 where there are none.
template <class Real>
std::array<Real, 3> velocity_of_bodies(const BodyFields<Real>& body, int cell) {
  const Real weight = std::max(body.exchange_weight[cell], Real(1e-6));
  return {body.weighted_velocity_x[cell] / weight, body.weighted_velocity_y[cell] / weight,
          body.weighted_velocity_z[cell] / weight};
}

}  // namespace lahar::lbm
