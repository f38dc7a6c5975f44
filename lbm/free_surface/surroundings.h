#pragma once
// What the interface cells of a block see around them: the block's cells and two cells beyond, laid out so that a row
// of cells sees its neighbours in any direction at a constant offset. What is yes or no is kept as bits: less to load.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/simd.h"

namespace lahar::lbm {

/// A bit per cell; rows along x in words, bit x + 2.
class SeenCells {
 public:
  static constexpr int at(int y, int z) { return (y + 2) + 12 * (z + 2); }
  void set_row(int y, int z, unsigned bits) { rows_[at(y, z)] = static_cast<std::uint16_t>(bits); }
  /// The twelve cells from (-2, y, z) on, as bits.
  [[nodiscard]] unsigned all_of_row(int y, int z) const { return rows_[at(y, z)]; }
  /// The eight cells from (x, y, z) on, as bits.
  [[nodiscard]] [[gnu::always_inline]] unsigned row(int x, int y, int z) const {
    return rows_[at(y, z)] >> (x + 2) & 0xFFU;
  }
  /// The same of the rows at y and y + 1.
  [[nodiscard]] [[gnu::always_inline]] unsigned two_rows(int x, int y, int z) const {
    const std::uint16_t* const first = rows_ + at(y, z);
    const unsigned both = (first[0] | static_cast<unsigned>(first[1]) << 16) >> (x + 2);
    return (both & 0xFFU) | (both >> 8 & 0xFF00U);
  }

 private:
  std::uint16_t rows_[12 * 12];
};

template <class Real>
struct Surroundings {
  static constexpr int rim = 2, pitch_y = 16, pitch_z = 12 * pitch_y;
  static constexpr int size = 12 * pitch_z;
  /// Share of a link's flux that is mass of an interface cell of fill level F: full, and F/2 more for interface cells.
  /// Liquid 1, interface half of its own fill level, all else 0.
  alignas(64) Real full[size];
  alignas(64) Real density[size];   ///< rho - 1 in wet cells; not to be used in others
  alignas(64) Real half_way[size];  ///< the same half a step on, where asked for (docs/decisions/0089)
  SeenCells interface, wet, empty;  ///< empty: gas and sinks
  SeenCells covered;                ///< by bodies (covered_cells.h)

  /// Place of cell (x, y, z), each -2..9.
  static constexpr int at(int x, int y, int z) { return (x + rim) + pitch_y * (y + rim) + pitch_z * (z + rim); }
};

/// What the cells of a row, or of two at y and y + 1, see at an offset of up to two cells. V: a pack of 8 numbers or of
/// 16. `y`, `z` of the (first) row.
template <class V>
class Sight {
 public:
  using Real = typename V::value_type;
  using Mask = typename V::mask_type;

  Sight(const Surroundings<Real>& near, int y, int z) : near_(near), y_(y), z_(z) {}

  template <int CX, int CY, int CZ>
  [[nodiscard]] [[gnu::always_inline]] V full() const {
    return numbers<CX, CY, CZ>(near_.full);
  }
  template <int CX, int CY, int CZ>
  [[nodiscard]] [[gnu::always_inline]] V density() const {
    return numbers<CX, CY, CZ>(near_.density);
  }
  template <int CX, int CY, int CZ>
  [[nodiscard]] [[gnu::always_inline]] V density_half_way() const {
    return numbers<CX, CY, CZ>(near_.half_way);
  }
  template <int CX, int CY, int CZ>
  [[nodiscard]] [[gnu::always_inline]] Mask interface() const {
    return cells<CX, CY, CZ>(near_.interface);
  }
  template <int CX, int CY, int CZ>
  [[nodiscard]] [[gnu::always_inline]] Mask wet() const {
    return cells<CX, CY, CZ>(near_.wet);
  }
  template <int CX, int CY, int CZ>
  [[nodiscard]] [[gnu::always_inline]] Mask liquid() const {
    return wet<CX, CY, CZ>() && !interface<CX, CY, CZ>();
  }
  template <int CX, int CY, int CZ>
  [[nodiscard]] [[gnu::always_inline]] Mask empty() const {
    return cells<CX, CY, CZ>(near_.empty);
  }
  template <int CX, int CY, int CZ>
  [[nodiscard]] [[gnu::always_inline]] Mask covered() const {
    return cells<CX, CY, CZ>(near_.covered);
  }

 private:
  static constexpr bool kTwo = V::size() == 2 * kRow;
  static_assert(kTwo || V::size() == kRow);

  template <int CX, int CY, int CZ>
  [[gnu::always_inline]] V numbers(const Real* field) const {
    const Real* const first = field + Surroundings<Real>::at(CX, y_ + CY, z_ + CZ);
    if constexpr (kTwo)
      return join(load<Row<Real>>(first), load<Row<Real>>(first + Surroundings<Real>::pitch_y));
    else
      return load<V>(first);
  }
  template <int CX, int CY, int CZ>
  [[gnu::always_inline]] Mask cells(const SeenCells& seen) const {
    return Mask::from_bits(kTwo ? seen.two_rows(CX, y_ + CY, z_ + CZ) : seen.row(CX, y_ + CY, z_ + CZ));
  }

  const Surroundings<Real>& near_;
  const int y_, z_;
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
