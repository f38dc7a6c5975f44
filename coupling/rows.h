#pragma once
// Rows of 8 cells as packs (core/simd.h): what grains and wires share when they write fields and gather loads.
#include "core/simd.h"
#include "lbm/grid/block.h"
#include "lbm/grid/row_types.h"

namespace lahar::coupling {

/// field <- change(field) in a row of a block.
template <class Real, class Change>
[[gnu::always_inline]] inline void update_row(Real* field, const Change& change) {
  store_aligned(field, change(load_aligned<Row<Real>>(field)));
}

template <class Real>
[[gnu::always_inline]] inline void add_to_row(Real* field, const Row<Real>& more) {
  store_aligned(field, load_aligned<Row<Real>>(field) + more);
}

/// Sum of the lanes in double precision, in their order.
template <class Real>
double sum_in_double(const Row<Real>& row) {
  double sum = 0;
  for (std::size_t c = 0; c < kRow; ++c) sum += static_cast<double>(static_cast<Real>(row[c]));
  return sum;
}

/// Volume of water in a row of cells, bodies included: 1 in liquid, the fill level at the surface, else 0.
template <class Real>
Row<Real> water_in(const lbm::Block<Real>& block, int row) {
  const auto wet = Row<Real>::mask_type::from_bits(lbm::wet_cells(block, row));
  const Row<Real> level =
      block.surface ? load_aligned<Row<Real>>(block.surface->fill_level + lbm::kBlockWidth * row) : Row<Real>(1);
  return select(wet, min(Row<Real>(1), max(Row<Real>(0), level)), Row<Real>(0));
}

/// Momentum that the bodies of a row of cells got in the last step along an axis, lu
/// (lbm/free_surface/lacking_liquid.h).
template <class Real>
[[gnu::always_inline]] inline Row<Real> given_row(const lbm::BodyFields<Real>& f, int first, int axis) {
  const Real* const exchange[3] = {f.momentum_exchange_x, f.momentum_exchange_y, f.momentum_exchange_z};
  const auto given = load_aligned<Row<Real>>(exchange[axis] + first);
  if (!f.lacks) return given;
  const Real* const lacking[3] = {f.lacking_x, f.lacking_y, f.lacking_z};
  return given - load_aligned<Row<Real>>(lacking[axis] + first);
}

/// 1 for the cells of a block for which `holds`, 0 for the others.
template <class Real>
struct CellMask {
  alignas(64) Real cells[lbm::kBlockCells];
  template <class Holds>
  CellMask(const lbm::Block<Real>& block, const Holds& holds) {
    for (std::size_t n = 0; n < lbm::kBlockCells; ++n) cells[n] = holds(block.type[n]) ? Real(1) : Real(0);
  }
  [[nodiscard]] [[gnu::always_inline]] Row<Real> row(int first) const { return load_aligned<Row<Real>>(cells + first); }
};

}  // namespace lahar::coupling
