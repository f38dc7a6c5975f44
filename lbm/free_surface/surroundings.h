#pragma once
// What the interface cells of a block see around them: the block's cells and two cells beyond, laid out so that a row
// of cells sees its neighbours in any direction at a constant offset.
#include <array>
#include <cstddef>
#include <cstdint>

namespace lahar::lbm {

template <class Real>
struct Surroundings {
  static constexpr int rim = 2, pitch_y = 16, pitch_z = 12 * pitch_y;
  static constexpr int size = 12 * pitch_z;
  /// Share of a link's flux that is mass of an interface cell of fill level F: full + half F. Liquid 1 and 0, interface
  /// half of its own fill level and 1/2, all else 0 and 0.
  alignas(64) Real full[size];
  alignas(64) Real half[size];
  alignas(64) Real empty[size];    ///< 1 in gas and sinks
  alignas(64) Real wet[size];      ///< 1 in liquid and interface
  alignas(64) Real density[size];  ///< rho - 1 in wet cells, else 0

  /// Place of cell (x, y, z), each -2..9.
  static constexpr int at(int x, int y, int z) { return (x + rim) + pitch_y * (y + rim) + pitch_z * (z + rim); }
  static constexpr int step(int cx, int cy, int cz) { return cx + cy * pitch_y + cz * pitch_z; }
};

/// Bits y + 2 of the rows z = -2..9 within two rows of the given ones (bit y + 8 z), themselves included.
inline std::array<std::uint32_t, 12> rows_around(std::uint64_t rows) {
  std::array<std::uint32_t, 12> needed{};
  for (std::size_t z = 0; z < 8; ++z) {
    const auto layer = static_cast<std::uint32_t>(rows >> (8 * z) & 0xFFU);
    const std::uint32_t wide = layer | layer << 1 | layer << 2 | layer << 3 | layer << 4;
    for (std::size_t k = z; k < z + 5; ++k) needed[k] |= wide;
  }
  return needed;
}

}  // namespace lahar::lbm
