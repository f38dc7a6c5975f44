#pragma once
// Body fields live only in blocks that a body or wire reaches in this step.
#include <algorithm>
#include <vector>

#include "lbm/fluid_grid.h"

namespace lahar::coupling {

/// Empties the fields before bodies and wires are written; sampled velocities stay.
template <class Real>
void clear_body_fields(lbm::FluidGrid<Real>& grid) {
  for (const lbm::BlockIndex b : grid.active()) {
    lbm::BodyFields<Real>* f = grid.block(b).body;
    if (!f) continue;
    f->used = false;
    for (Real* field :
         {f->solid_fraction, f->momentum_x, f->momentum_y, f->momentum_z, f->exchange_x, f->exchange_y, f->exchange_z})
      std::fill(field, field + lbm::kBlockCells, Real(0));
  }
}

/// Gives back the fields of blocks that nothing was written to.
template <class Real>
void release_unused_body_fields(lbm::FluidGrid<Real>& grid) {
  for (const lbm::BlockIndex b : grid.active())
    if (grid.block(b).body && !grid.block(b).body->used) grid.release_body(b);
}

}  // namespace lahar::coupling
