#pragma once
// Rows of 8 cells as SIMD vectors: what grains and wires share when they write fields and gather loads.
#include "core/multiply_add.h"
#include "lbm/grid/block.h"
#include "lbm/step/gather.h"

namespace lahar::coupling {

namespace stdx = std::experimental;

/// 0, 1, ... 7
template <class Real>
[[gnu::always_inline]] inline lbm::Row<Real> row_places() {
  return lbm::Row<Real>([](auto k) { return static_cast<Real>(k); });
}

/// field <- change(field) in a row of a block.
template <class Real, class Change>
[[gnu::always_inline]] inline void update_row(Real* field, const Change& change) {
  change(lbm::Row<Real>(field, stdx::vector_aligned)).copy_to(field, stdx::vector_aligned);
}

template <class Real>
[[gnu::always_inline]] inline void add_to_row(Real* field, const lbm::Row<Real>& more) {
  (lbm::Row<Real>(field, stdx::vector_aligned) + more).copy_to(field, stdx::vector_aligned);
}

/// 1 for the cells of a block for which `holds`, 0 for the others.
template <class Real>
struct CellMask {
  alignas(64) Real cells[lbm::kBlockCells];
  template <class Holds>
  CellMask(const lbm::Block<Real>& block, const Holds& holds) {
    for (std::size_t n = 0; n < lbm::kBlockCells; ++n) cells[n] = holds(block.type[n]) ? Real(1) : Real(0);
  }
  [[nodiscard]] [[gnu::always_inline]] lbm::Row<Real> row(int first) const {
    return lbm::Row<Real>(cells + first, stdx::vector_aligned);
  }
};

}  // namespace lahar::coupling
