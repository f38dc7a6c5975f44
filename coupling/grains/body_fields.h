#pragma once
// Body fields live only in blocks that a body or wire reaches in this step.
#include <algorithm>
#include <vector>

#include "core/parallel.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::coupling {

/// Before bodies and wires are written: nothing goes into the exchange, and fields that no body map looks after are
/// emptied. What a body map wrote it replaces itself where that is due; sampled velocities stay.
template <class Real>
void clear_body_fields(lbm::FluidGrid<Real>& grid) {
  for (const lbm::BlockIndex b : grid.owned()) {
    lbm::BodyFields<Real>* f = grid.block(b).body;
    if (!f) continue;
    f->used = false;
    // Dry rows are left out by the sweep and keep what stands there.
    if (f->no_kicks = grid.block(b).wet_cells == lbm::kBlockCells; !f->no_kicks)
      for (Real* field : {f->exchange_x, f->exchange_y, f->exchange_z})
        std::fill(field, field + lbm::kBlockCells, Real(0));
    if ((f->mapped || f->wired) && !f->edited) continue;
    for (Real* field : {f->solid_fraction, f->coverage, f->resistance, f->momentum_x, f->momentum_y, f->momentum_z})
      std::fill(field, field + lbm::kBlockCells, Real(0));
    f->mapped = f->wired = f->edited = false;
  }
}

/// Gives back the fields of blocks that nothing was written to.
template <class Real>
void release_unused_body_fields(lbm::FluidGrid<Real>& grid) {
  for (const lbm::BlockIndex b : grid.owned())
    if (grid.block(b).body && !grid.block(b).body->used) grid.release_body(b);
}

/// Momentum that the fluid gave to bodies in the last step, lu, read cell by cell: the fluid's side of the audit.
template <class Real>
Vec3 momentum_given_to_bodies(const lbm::FluidGrid<Real>& grid) {
  const auto& active = grid.owned();
  return ordered_sum<Vec3>(
      active.size(),
      [&](std::size_t k) {
        Vec3 sum = Vec3::Zero();
        const lbm::BodyFields<Real>* f = grid.block(active[k]).body;
        if (!f) return sum;
        for (int n = 0; n < lbm::kBlockCells; ++n) {
          if (f->coverage[n] == 0) continue;
          sum += Vec3(static_cast<double>(f->exchange_x[n]), static_cast<double>(f->exchange_y[n]),
                      static_cast<double>(f->exchange_z[n]));
        }
        return sum;
      },
      16, Vec3(Vec3::Zero()));
}

}  // namespace lahar::coupling
