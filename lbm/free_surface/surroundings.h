#pragma once
// What the interface cells of a block see around them: the block's cells and two cells beyond, laid out so that a row
// of cells sees its neighbours in any direction at a constant offset.
#include <experimental/simd>

#include "lbm/cell_moments.h"
#include "lbm/gather.h"

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

/// rho - 1 after the last collision in the row that starts with cell `first` of a block with these neighbours.
template <class Real>
Row<Real> outgoing_density(const std::array<Block<Real>*, 27>& around, int first, Parity parity) {
  const Rows rows = Rows::at(first, 1);
  Row<Real> drho(around[13]->f(0) + first, stdx::element_aligned);
  for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
    const ShiftedVelocity<CX, CY, CZ, Real> ahead(around, parity.home(D3Q19::forward(P)), nullptr);
    drho += ahead.template load<Row<Real>>(rows) +
            Row<Real>(around[13]->f(parity.away(D3Q19::forward(P))) + first, stdx::element_aligned);
  });
  return drho;
}

/// Fills what the interface cells of given rows see.
template <class Real>
class LookAround {
 public:
  LookAround(FluidGrid<Real>& grid, BlockIndex b, Parity parity) : grid_(grid), index_(b), parity_(parity) {}

  void run(std::uint64_t rows, Surroundings<Real>& s) {
    const auto needed = rows_around(rows);
    for (int z = -2; z < 10; ++z)
      for (int y = -2; y < 10; ++y)
        if (needed[static_cast<std::size_t>(z + 2)] >> (y + 2) & 1U) see_row(s, y, z);
  }

 private:
  using V = Row<Real>;

  void see_row(Surroundings<Real>& s, int y, int z) {
    const int by = y < 0 ? -1 : (y > 7 ? 1 : 0), bz = z < 0 ? -1 : (z > 7 ? 1 : 0);
    const int row = cell_index(0, y & 7, z & 7), place = Surroundings<Real>::at(0, y, z);
    see_side(s, place - 2, neighbour_slot(-1, by, bz), row + 6);
    see_eight(s, place, neighbour_slot(0, by, bz), row);
    see_side(s, place + 8, neighbour_slot(1, by, bz), row);
  }

  /// A whole row of a block.
  void see_eight(Surroundings<Real>& s, int place, int slot, int first) {
    const Block<Real>* block = grid_.around(index_)[static_cast<std::size_t>(slot)];
    const V one(1), zero(0);
    const auto put = [&](Real* field, const V& values) { values.copy_to(field + place, stdx::element_aligned); };
    if (!block || !(block->wet_rows >> (first / kBlockWidth) & 1)) {
      // Nothing wet: walls count as neither, all else is empty.
      put(s.full, zero), put(s.half, zero), put(s.wet, zero), put(s.density, zero), put(s.empty, one);
      for (int k = 0; block && k < kBlockWidth; ++k)
        if (block->type[static_cast<std::size_t>(first + k)] == CellType::wall) s.empty[place + k] = 0;
      return;
    }
    const V type = types_of(*block, first);
    const auto is = [&](CellType t) { return type == V(static_cast<Real>(t)); };
    V full = zero, half = zero, empty = zero, wet = zero, density = zero;
    stdx::where(is(CellType::liquid), full) = one;
    stdx::where(is(CellType::interface), half) = V(Real(0.5));
    stdx::where(is(CellType::gas) || is(CellType::sink), empty) = one;
    stdx::where(is(CellType::liquid) || is(CellType::interface), wet) = one;
    if (block->surface) {
      full += half * V(block->surface->fill_level + first, stdx::element_aligned);
      density = wet * V(block->surface->density + first, stdx::element_aligned);
    }
    put(s.full, full), put(s.half, half), put(s.empty, empty), put(s.wet, wet), put(s.density, density);
    if (block->surface) return;
    const BlockIndex b = grid_.topology().neighbours(index_)[static_cast<std::size_t>(slot)];
    put(s.density, wet * outgoing_density(grid_.around(b), first, parity_));
  }

  /// The types of a row's cells as numbers.
  static V types_of(const Block<Real>& block, int first) {
    using Bytes [[gnu::vector_size(kBlockWidth)]] = std::uint8_t;
    using Words [[gnu::vector_size(4 * kBlockWidth)]] = std::int32_t;
    Bytes bytes;
    std::memcpy(&bytes, block.type.data() + first, sizeof(bytes));
    const auto numbers = __builtin_convertvector(__builtin_convertvector(bytes, Words), typename RowsOf<Real, 1>::type);
    return V(reinterpret_cast<const Real*>(&numbers), stdx::vector_aligned);
  }

  /// The two cells of a row that lie in a block beside it.
  void see_side(Surroundings<Real>& s, int place, int slot, int first) {
    const Block<Real>* block = grid_.around(index_)[static_cast<std::size_t>(slot)];
    for (int k = 0; k < Surroundings<Real>::rim; ++k) {
      const CellType type = block ? block->type[static_cast<std::size_t>(first + k)] : CellType::gas;
      const bool surface = block && block->surface;
      s.half[place + k] = type == CellType::interface ? Real(0.5) : Real(0);
      s.full[place + k] = type == CellType::liquid ? Real(1)
                          : surface                ? s.half[place + k] * block->surface->fill_level[first + k]
                                                   : Real(0);
      s.empty[place + k] = type == CellType::gas || type == CellType::sink ? Real(1) : Real(0);
      s.wet[place + k] = is_wet(type) ? Real(1) : Real(0);
      s.density[place + k] = surface && is_wet(type) ? block->surface->density[first + k] : Real(0);
    }
    if (block && !block->surface) compute_density(s, place, slot, first, Surroundings<Real>::rim);
  }

  /// Density of cells beside the row's ends; the sweep keeps none of blocks without a surface.
  void compute_density(Surroundings<Real>& s, int place, int slot, int first, int count) {
    const BlockIndex b = grid_.topology().neighbours(index_)[static_cast<std::size_t>(slot)];
    for (int k = 0; k < count; ++k)
      if (s.wet[place + k] > 0) s.density[place + k] = outgoing_moments(grid_, {b, first + k}, parity_).drho;
  }

  FluidGrid<Real>& grid_;
  const BlockIndex index_;
  const Parity parity_;
};

}  // namespace lahar::lbm
