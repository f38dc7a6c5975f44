#pragma once
// Body fields live only in blocks that a body or wire reaches in this step. Who wrote them is known here, so that what
// did not change can stay.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "coupling/rows.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::coupling {

/// Empties what is written of bodies; what the sweep left stays.
template <class Real>
void clear_solids(lbm::BodyFields<Real>& f) {
  for (Real* field : {f.solid_fraction, f.exchange_weight, f.drag, f.weighted_velocity_x, f.weighted_velocity_y,
                      f.weighted_velocity_z})
    std::fill(field, field + lbm::kBlockCells, Real(0));
  f.covered.fill(0);
  f.fills_with_level = false;
}

/// A step: open, then everybody writes into the fields of the blocks that he reaches, then close.
template <class Real>
class SolidFields {
 public:
  /// Whose work stands in the fields of a block.
  enum class Writer : std::uint8_t {
    none,     ///< nobody's: they are empty
    grains,   ///< of the grains alone, who replace it themselves where that is due
    wires,    ///< of mapped wires alone, who do the same
    several,  ///< emptied before the next step
  };

  /// Before bodies and wires are written: nobody reaches a block yet, and what several wrote is emptied.
  void open(lbm::FluidGrid<Real>& grid) {
    for (const lbm::BlockIndex b : grid.owned()) {
      lbm::Block<Real>& block = grid.block(b);
      Entry& e = entry(b);
      e.reached = false;
      if (!block.body || e.birth != block.birth) e.writer = Writer::none;
      e.birth = block.birth;
      if (!block.body || e.writer == Writer::grains || e.writer == Writer::wires) continue;
      clear_solids(*block.body);
      e.writer = Writer::none;
    }
  }

  /// The fields of a block that somebody reaches in this step.
  lbm::BodyFields<Real>& reach(lbm::FluidGrid<Real>& grid, lbm::BlockIndex b) {
    Entry& e = entry(b);
    if (!grid.block(b).body || e.birth != grid.block(b).birth) e = {grid.block(b).birth, Writer::none, false, true};
    e.reached = true;
    return grid.require_body(b);
  }
  /// The same for somebody who writes on top of what stands there and keeps no book of it.
  lbm::BodyFields<Real>& write_over(lbm::FluidGrid<Real>& grid, lbm::BlockIndex b) {
    lbm::BodyFields<Real>& fields = reach(grid, b);
    set_writer(b, Writer::several);
    return fields;
  }

  /// Whether a block that was reached got its fields since the last step: no sweep has left anything there yet.
  [[nodiscard]] bool is_fresh(lbm::BlockIndex b) const { return entries_[static_cast<std::size_t>(b)].fresh; }

  /// Of a block with body fields, after open().
  [[nodiscard]] Writer writer(lbm::BlockIndex b) const {
    const auto k = static_cast<std::size_t>(b);
    return k < entries_.size() ? entries_[k].writer : Writer::none;
  }
  void set_writer(lbm::BlockIndex b, Writer writer) { entry(b).writer = writer; }

  /// Releases the fields of blocks that nobody reached. The sweep follows.
  void close(lbm::FluidGrid<Real>& grid) {
    for (const lbm::BlockIndex b : grid.owned()) {
      entry(b).fresh = false;
      if (!grid.block(b).body || entry(b).reached) continue;
      grid.release_body(b);
      set_writer(b, Writer::none);
    }
  }

 private:
  struct Entry {
    std::uint64_t birth = 0;  ///< of the block: its index may be used again
    Writer writer = Writer::none;
    bool reached = false;
    bool fresh = false;
  };
  Entry& entry(lbm::BlockIndex b) {
    const auto k = static_cast<std::size_t>(b);
    if (k >= entries_.size()) entries_.resize(k + 1);
    return entries_[k];
  }

  std::vector<Entry> entries_;  // by block index
};

/// Momentum that the fluid gave to bodies in the last step, lu, read cell by cell: the fluid's side of the audit.
template <class Real>
Vec3 momentum_given_to_bodies(const lbm::FluidGrid<Real>& grid) {
  const auto& active = grid.owned();
  return ordered_sum<Vec3>(
      active.size(),
      [&](std::size_t k) {
        const lbm::BodyFields<Real>* f = grid.block(active[k]).body;
        if (!f) return Vec3(Vec3::Zero());
        double sums[3][lbm::kBlockWidth]{};  // by place in a row
        for (int n = 0; n < lbm::kBlockCells; n += lbm::kBlockWidth)
          for (int a = 0; a < 3; ++a) {
            const Row<Real> given = given_row(*f, n, a);
            for (std::size_t c = 0; c < lbm::kBlockWidth; ++c) sums[a][c] += static_cast<double>(given[c]);
          }
        Vec3 sum = Vec3::Zero();
        for (int a = 0; a < 3; ++a)
          for (const double x : sums[a]) sum[a] += x;
        return sum;
      },
      16, Vec3(Vec3::Zero()));
}

}  // namespace lahar::coupling
