#include "lbm/step/dry_blocks.h"

#include <algorithm>
#include <bit>

#include "lbm/grid/cell_set.h"
#include "lbm/grid/row_types.h"

namespace lahar::lbm {

namespace {

/// The blocks (bits by neighbour_slot) that hold neighbours of a block's wet cells, itself included.
template <class Real>
std::uint32_t slots_reached(const Block<Real>& block) {
  constexpr std::uint64_t first_y = 0x0101010101010101U, first_z = 0xFFU;
  const std::uint64_t rows = block.wet_rows;
  unsigned columns = block.wet_cells == kBlockCells ? 0xFFU : 0U;
  for (std::uint64_t left = columns ? 0 : rows; left != 0; left &= left - 1)
    columns |= wet_cells(block, std::countr_zero(left));
  return slots_within({{{(columns & 1U) != 0, true, columns >> 7 != 0},
                        {(rows & first_y) != 0, true, (rows & first_y << 7) != 0},
                        {(rows & first_z) != 0, true, (rows & first_z << 56) != 0}}});
}

/// Whether cells of a block gave bodies momentum in the last step, which is still to be gathered.
template <class Real>
bool gave_to_bodies(const Block<Real>& block) {
  return block.body && std::any_of(std::begin(block.body->coverage_weight), std::end(block.body->coverage_weight),
                                   [](Real weight) { return weight != 0; });
}

}  // namespace

template <class Real>
void release_dry_blocks(FluidGrid<Real>& grid) {
  std::vector<std::uint8_t> needed(grid.topology().capacity(), 0);
  for (const BlockIndex b : grid.owned()) {
    if (grid.block(b).wet_cells == 0) continue;
    for (std::uint32_t slots = slots_reached(grid.block(b)); slots != 0; slots &= slots - 1) {
      const BlockIndex other = grid.topology().neighbours(b)[static_cast<std::size_t>(std::countr_zero(slots))];
      if (other != kNoBlock) needed[static_cast<std::size_t>(other)] = 1;
    }
  }
  std::vector<BlockIndex> gone;
  for (const BlockIndex b : grid.owned())
    if (!needed[static_cast<std::size_t>(b)] && !gave_to_bodies(grid.block(b))) gone.push_back(b);
  for (const BlockIndex b : gone) grid.release(b);
}

template void release_dry_blocks<float>(FluidGrid<float>&);
template void release_dry_blocks<double>(FluidGrid<double>&);

}  // namespace lahar::lbm
