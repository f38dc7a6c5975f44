#pragma once
// What the files of WireMap share.
#include <optional>

#include "core/parallel.h"
#include "coupling/wires/wire_map.h"

namespace lahar::coupling {

/// Calls visit(block index) for the blocks that pieces reach.
template <class Real>
template <class Visit>
void WireMap<Real>::for_each_block(const Visit& visit) const {
  const std::size_t blocks = block_start_.empty() ? 0 : block_start_.size() - 1;
  parallel_for(0, blocks, 8, [&](std::size_t b) {
    if (block_start_[b] < block_start_[b + 1]) visit(b);
  });
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

/// Arms of the cells of a row from a place.
template <class Real>
struct ArmRow {
  lbm::Row<Real> x;
  Real y, z;
  [[gnu::always_inline]] static ArmRow from(const Real (&place)[3], int x0, int y, int z) {
    return {(static_cast<Real>(x0) + Real(0.5) - place[0]) + row_places<Real>(),
            static_cast<Real>(y) + Real(0.5) - place[1], static_cast<Real>(z) + Real(0.5) - place[2]};
  }
};

/// Calls visit(first cell of the row, what the piece covers of it, the row's y and z) for the rows of a block that the
/// piece reaches, as far as `reach` from its axis.
template <bool kByDistance, class Real, class Visit>
[[gnu::always_inline]] inline void for_piece_rows(const GridPiece<Real>& piece, const Vec3i& lowest, Real reach,
                                                  const Visit& visit) {
  for_rows_in(
      box_of(piece, reach), lowest, [&](int y, int z) __attribute__((always_inline)) {
        const PieceRow<Real> cover = piece_row<kByDistance>(piece, lowest.x(), lowest.y() + y, lowest.z() + z);
        visit(lbm::cell_index(0, y, z), cover, lowest.y() + y, lowest.z() + z);
      });
}

}  // namespace lahar::coupling
