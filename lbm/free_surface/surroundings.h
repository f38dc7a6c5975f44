#pragma once
// What the interface cells of a block see around them: the block's cells and one cell beyond, laid out so that a row of
// cells sees its neighbours in any direction at a constant offset.
#include "lbm/block.h"

namespace lahar::lbm {

template <class Real>
struct Surroundings {
  static constexpr int pitch_y = 16, pitch_z = 160;
  static constexpr int size = 10 * pitch_z;
  /// Share of a link's flux that is mass of an interface cell of fill level F: full + half F. Liquid 1 and 0, interface half
  /// of its own fill level and 1/2, all else 0 and 0.
  alignas(64) Real full[size];
  alignas(64) Real half[size];
  alignas(64) Real empty[size];  ///< 1 in gas and sinks

  /// Place of cell (x, y, z), each -1..8.
  static constexpr int at(int x, int y, int z) { return (x + 1) + pitch_y * (y + 1) + pitch_z * (z + 1); }
};

template <class Real>
[[gnu::always_inline]] inline void see_cell(Surroundings<Real>& s, int place, const Block<Real>* block, int cell) {
  const CellType type = block ? block->type[static_cast<std::size_t>(cell)] : CellType::gas;
  const bool interface = type == CellType::interface;
  const Real fill = interface ? block->surface->fill_level[cell] : Real(0);
  s.full[place] = type == CellType::liquid ? Real(1) : Real(0.5) * fill;
  s.half[place] = interface ? Real(0.5) : Real(0);
  s.empty[place] = type == CellType::gas || type == CellType::sink ? Real(1) : Real(0);
}

/// Bits y + 1 of the rows z = -1..8 that touch one of the given rows (bit y + 8 z), themselves included.
inline std::array<std::uint32_t, 10> touching_rows(std::uint64_t rows) {
  std::array<std::uint32_t, 10> needed{};
  for (std::size_t z = 0; z < 8; ++z) {
    const auto layer = static_cast<std::uint32_t>(rows >> (8 * z) & 0xFFU);
    const std::uint32_t wide = layer | layer << 1 | layer << 2;
    for (std::size_t k = z; k < z + 3; ++k) needed[k] |= wide;
  }
  return needed;
}

/// Fills what the interface cells of the given rows see.
template <class Real>
void look_around(const std::array<Block<Real>*, 27>& around, std::uint64_t rows, Surroundings<Real>& s) {
  const auto needed = touching_rows(rows);
  for (int z = -1; z < 9; ++z)
    for (int y = -1; y < 9; ++y) {
      if (!(needed[static_cast<std::size_t>(z + 1)] >> (y + 1) & 1U)) continue;
      const int by = y < 0 ? -1 : (y > 7 ? 1 : 0), bz = z < 0 ? -1 : (z > 7 ? 1 : 0);
      const int row = cell_index(0, y & 7, z & 7), place = Surroundings<Real>::at(0, y, z);
      const auto slot = [&](int bx) { return static_cast<std::size_t>(neighbour_slot(bx, by, bz)); };
      see_cell(s, place - 1, around[slot(-1)], row + 7);
      see_cell(s, place + 8, around[slot(1)], row);
      const Block<Real>* block = around[slot(0)];
      if (block && block->surface) {
        const SurfaceFields<Real>& surface = *block->surface;
        for (int k = 0; k < 8; ++k) {
          const CellType type = block->type[static_cast<std::size_t>(row + k)];
          const bool interface = type == CellType::interface;
          const Real fill = surface.fill_level[row + k];
          s.full[place + k] = type == CellType::liquid ? Real(1) : (interface ? Real(0.5) * fill : Real(0));
          s.half[place + k] = interface ? Real(0.5) : Real(0);
          s.empty[place + k] = type == CellType::gas || type == CellType::sink ? Real(1) : Real(0);
        }
      } else {
        for (int k = 0; k < 8; ++k) see_cell(s, place + k, block, row + k);
      }
    }
}

}  // namespace lahar::lbm
