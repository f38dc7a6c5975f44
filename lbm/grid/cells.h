#pragma once
// Cells of an 8 x 8 x 8 block: types, indices, and where a cell's neighbours lie. Cell (x, y, z) is at x + 8 y + 64 z:
// rows of 8 cells run along x, so that a layer of liquid on a bed, thin along z, fills whole rows and leaves the others
// empty (docs/decisions/0008).
#include <array>
#include <cstdint>

#include "core/vector.h"
#include "lbm/grid/velocity_set.h"

namespace lahar::lbm {

inline constexpr int kBlockWidth = 8;
inline constexpr int kBlockCells = 512;

using BlockIndex = std::int32_t;
inline constexpr BlockIndex kNoBlock = -1;

enum class CellType : std::uint8_t {
  gas,        ///< empty; not simulated
  interface,  ///< partly filled, tracks its mass
  liquid,     ///< full
  wall,       ///< solid wall
  sink,       ///< outside an open face of the domain: liquid that gets here has left
};

inline bool is_wet(CellType t) { return t == CellType::interface || t == CellType::liquid; }

constexpr int cell_index(int x, int y, int z) { return x + 8 * y + 64 * z; }
constexpr std::array<int, 3> cell_position(int cell) { return {cell & 7, (cell >> 3) & 7, cell >> 6}; }
/// Index 0..26 of a neighbour block at offset (dx, dy, dz), each -1..1; 13 is the block itself.
constexpr int neighbour_slot(int dx, int dy, int dz) { return 9 * (dx + 1) + 3 * (dy + 1) + dz + 1; }

/// Where the cell at n + c_i lies: the slot (0..26) of its block, and the cell there. By cell, so that all links of one
/// lie in one cache line or two: such cells are looked at one by one.
struct NeighbourTable {
  [[nodiscard]] constexpr std::size_t slot(int i, int n) const { return links[n][i] >> 9; }
  [[nodiscard]] constexpr int cell(int i, int n) const { return links[n][i] & (kBlockCells - 1); }

  alignas(64) std::uint16_t links[kBlockCells][D3Q19::q];  ///< slot << 9 | cell
};

constexpr NeighbourTable make_neighbour_table() {
  NeighbourTable t{};
  for (int i = 0; i < D3Q19::q; ++i)
    for (int n = 0; n < kBlockCells; ++n) {
      const auto p = cell_position(n);
      int block[3] = {0, 0, 0}, local[3] = {0, 0, 0};
      for (int a = 0; a < 3; ++a) {
        const int v = p[static_cast<std::size_t>(a)] + D3Q19::c[i][a];
        block[a] = v < 0 ? -1 : (v > 7 ? 1 : 0);
        local[a] = v & 7;
      }
      t.links[n][i] = static_cast<std::uint16_t>(neighbour_slot(block[0], block[1], block[2]) << 9 |
                                                 cell_index(local[0], local[1], local[2]));
    }
  return t;
}

extern const NeighbourTable kNeighbours;

/// Floor division by the block width: block coordinate of a cell coordinate.
inline Vec3i block_of(const Vec3i& cell) { return {cell.x() >> 3, cell.y() >> 3, cell.z() >> 3}; }

}  // namespace lahar::lbm
