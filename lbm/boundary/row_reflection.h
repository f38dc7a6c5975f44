#pragma once
// Reflection off walls at rest and mirrors, a row of cells at a time.
//
// What comes back over a link is then a copy of what was sent: by the cell itself, or, off a mirror, by the cell beside
// it (slip_wall.h). In Esoteric Pull both lie in rows (streaming.h): with c_i = into + along and the source's velocity
// c_j = into - along, the numbers that come back to the row n lie
//   in slot away(i) of the row n + c_i where i is a forward velocity, else in slot home(i - 1) of the row n,
// and those that were sent
//   in slot home(j) of the row n + along + c_j where j is a forward velocity, else in slot away(j - 1) of n + along.
// Either place is shifted along x by 1 if i is forward with c_x = 1, and both by the same, so that lanes agree. A place
// that is written belongs to one link of one wet cell; those that are read are the incoming ones of wall cells. So the
// order does not matter.
#include "lbm/collision/equilibrium.h"
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Lists the links of a block that rows can reflect, and the wall cells whose links they cannot. `lowest`: the block's
/// first cell.
void list_row_links(WallLinks& walls, const Domain& domain, const Vec3i& lowest);

/// Sets what comes back to the wet cells of a block over the listed links; notes those that led to another cell.
/// `order` is that of the collision operator's equilibrium.
template <class Real>
void reflect_rows(FluidGrid<Real>& grid, BlockIndex b, Parity parity, EquilibriumOrder order);

/// The links that led to another cell at the last reflection, by cell.
class MirroredLinks {
 public:
  explicit MirroredLinks(const WallLinks& walls);
  /// Those of a wall cell, by bit k of its links.
  [[nodiscard]] std::uint32_t of(const WallCell& wall, const std::uint8_t* directions) const;
  /// The reverse, for checkpoints: `of_cells` by entry of walls.cells.
  static void restore(WallLinks& walls, const std::uint32_t* of_cells);

 private:
  std::array<std::array<std::uint8_t, D3Q19::q>, 64> cells_{};  ///< by row and velocity
};

/// The links of mirrors that lead along the wall, to the cell beside or to gas there. The others are sent back: those
/// straight across, those into edges, and those towards cells that a no-slip wall holds.
class LinksAlongMirrors {
 public:
  explicit LinksAlongMirrors(const WallLinks& walls);
  [[nodiscard]] bool contain(int cell, int i) const {
    return (cells_[static_cast<std::size_t>(cell / kBlockWidth)][static_cast<std::size_t>(i)] >> (cell % kBlockWidth) &
            1) != 0;
  }

 private:
  std::array<std::array<std::uint8_t, D3Q19::q>, 64> cells_{};  ///< by row and velocity
};

extern template void reflect_rows<float>(FluidGrid<float>&, BlockIndex, Parity, EquilibriumOrder);
extern template void reflect_rows<double>(FluidGrid<double>&, BlockIndex, Parity, EquilibriumOrder);

}  // namespace lahar::lbm
