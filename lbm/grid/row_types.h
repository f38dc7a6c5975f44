#pragma once
// The types of a row's eight cells at once, as bits: bit k is the cell at x = k.
#include <bit>
#include <cstring>

#include "lbm/grid/block.h"

namespace lahar::lbm {

static_assert(std::endian::native == std::endian::little, "the first cell of a row is the lowest byte");

/// The lowest bit of every byte, gathered: byte k to bit k.
inline unsigned gather_bytes(std::uint64_t bytes) {
  return static_cast<unsigned>((bytes & 0x0101010101010101U) * 0x0102040810204080U >> 56);
}

/// The types of a row (y + 8 z), one to a byte.
template <class Real>
std::uint64_t types_of_row(const Block<Real>& block, int row) {
  std::uint64_t types;
  std::memcpy(&types, block.type.data() + kBlockWidth * row, sizeof(types));
  return types;
}

/// Wet cells. Of the types only interface (1) and liquid (2) have the second bit set once one is added.
inline unsigned wet_cells(std::uint64_t types) {
  static_assert(static_cast<int>(CellType::interface) == 1 && static_cast<int>(CellType::liquid) == 2 &&
                static_cast<int>(CellType::sink) == 4);
  return gather_bytes((types + 0x0101010101010101U) >> 1);
}

/// Interface cells: of the types with the lowest bit, interface (1) and wall (3), that without the second.
inline unsigned interface_cells(std::uint64_t types) {
  static_assert(static_cast<int>(CellType::gas) == 0 && static_cast<int>(CellType::wall) == 3);
  return gather_bytes(types & ~(types >> 1));
}

/// Liquid (2): wet and no interface.
inline unsigned liquid_cells(std::uint64_t types) { return wet_cells(types) & ~interface_cells(types); }

/// Walls: the type (3) with both of the lowest bits.
inline unsigned wall_cells(std::uint64_t types) { return gather_bytes(types & (types >> 1)); }

/// Gas (0) and sinks (4): the types with neither of the lowest two bits.
inline unsigned empty_cells(std::uint64_t types) { return gather_bytes(~(types | types >> 1)); }

template <class Real>
unsigned wet_cells(const Block<Real>& block, int row) {
  return wet_cells(types_of_row(block, row));
}

template <class Real>
unsigned interface_cells(const Block<Real>& block, int row) {
  return interface_cells(types_of_row(block, row));
}

}  // namespace lahar::lbm
