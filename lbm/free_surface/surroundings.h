#pragma once
// What the interface cells of a block see around them: the block's cells and two cells beyond, laid out so that a row
// of cells sees its neighbours in any direction at a constant offset.
#include <experimental/simd>

#include "lbm/fluid_grid.h"
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

/// Velocity (CX, CY, CZ) seen ahead of the row that starts with cell `first`: the numbers at n + (CX, CY, CZ). A
/// missing block reads as rest at density 1.
template <int CX, int CY, int CZ, class Real>
[[gnu::always_inline]] inline Row<Real> row_ahead(const std::array<Block<Real>*, 27>& around, int velocity, int first) {
  using Numbers = typename RowsOf<Real, 1>::type;
  const auto p = cell_position(first);
  const int y = p[1] + CY, z = p[2] + CZ, there = cell_index(0, y & 7, z & 7);
  const auto slot = static_cast<std::size_t>(neighbour_slot(0, y >> 3, z >> 3));
  const auto load = [&](const Block<Real>* block) __attribute__((always_inline)) {
    Numbers v;
    std::memcpy(&v, block ? block->f(velocity) + there : kRest<Real>, sizeof(v));
    return v;
  };
  Numbers v = load(around[slot]);
  if constexpr (CX == 1) v = __builtin_shufflevector(v, load(around[slot + 9]), 1, 2, 3, 4, 5, 6, 7, 8);
  return Row<Real>(reinterpret_cast<const Real*>(&v), stdx::vector_aligned);
}

/// rho - 1 after the last collision in the row that starts with cell `first` of a block with these neighbours.
template <class Real>
Row<Real> outgoing_density(const std::array<Block<Real>*, 27>& around, int first, Parity parity) {
  Row<Real> drho(around[13]->f(0) + first, stdx::element_aligned);
  for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
    drho += row_ahead<CX, CY, CZ>(around, parity.home(D3Q19::forward(P)), first) +
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
  /// A row and two cells to either side, in a vector of sixteen.
  using Sixteen = typename RowsOf<Real, 2>::type;

  /// Eight cells of a block.
  struct Piece {
    std::uint64_t types = 0;  ///< gas where there is no block
    const Real *fill_level = kRest<Real>, *density = kRest<Real>;
  };

  void see_row(Surroundings<Real>& s, int y, int z) {
    const int by = y < 0 ? -1 : (y > 7 ? 1 : 0), bz = z < 0 ? -1 : (z > 7 ? 1 : 0);
    const int first = cell_index(0, y & 7, z & 7);
    alignas(64) Real before[kBlockWidth], own[kBlockWidth], after[kBlockWidth];
    const Piece left = look(neighbour_slot(-1, by, bz), first, before),
                here = look(neighbour_slot(0, by, bz), first, own),
                right = look(neighbour_slot(1, by, bz), first, after);
    const Sixteen type = types_of(left.types >> 48 | here.types << 16, here.types >> 48 | right.types << 16);
    const auto is = [&](CellType t) __attribute__((always_inline)) { return type == static_cast<Real>(t); };
    const Sixteen zero = {}, one = zero + 1, half = zero + Real(0.5);
    const auto liquid = is(CellType::liquid), interface = is(CellType::interface), wet = liquid | interface;
    const int place = Surroundings<Real>::at(-2, y, z);
    const auto put = [&](Real * field, const Sixteen& values) __attribute__((always_inline)) {
      std::memcpy(field + place, &values, sizeof(values));
    };
    const Sixteen fill = join(left.fill_level, here.fill_level, right.fill_level);
    put(s.full, liquid ? one : (interface ? half * fill : zero));
    put(s.half, interface ? half : zero);
    put(s.empty, (is(CellType::gas) | is(CellType::sink)) ? one : zero);
    put(s.wet, wet ? one : zero);
    put(s.density, wet ? join(left.density, here.density, right.density) : zero);
  }

  /// The sweep keeps no density of blocks without a surface: it is computed into `buffer` where cells are wet.
  Piece look(int slot, int first, Real* buffer) const {
    const Block<Real>* block = grid_.around(index_)[static_cast<std::size_t>(slot)];
    Piece piece;
    if (!block) return piece;
    std::memcpy(&piece.types, block->type.data() + first, sizeof(piece.types));
    if (block->surface) {
      piece.fill_level = block->surface->fill_level + first;
      piece.density = block->surface->density + first;
    } else if (block->wet_rows >> (first / kBlockWidth) & 1) {
      const BlockIndex b = grid_.topology().neighbours(index_)[static_cast<std::size_t>(slot)];
      outgoing_density(grid_.around(b), first, parity_).copy_to(buffer, stdx::vector_aligned);
      piece.density = buffer;
    }
    return piece;
  }

  /// The last two numbers of a row, a row, the first two of another, and four that are of no use.
  static Sixteen join(const Real* left, const Real* here, const Real* right) {
    using Eight = typename RowsOf<Real, 1>::type;
    const auto load = [](const Real* p) __attribute__((always_inline)) {
      Eight v;
      std::memcpy(&v, p, sizeof(v));
      return v;
    };
    const Eight a = load(left), b = load(here), c = load(right);
    const Sixteen ab = __builtin_shufflevector(a, b, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0, 0, 0, 0, 0, 0);
    const Sixteen cc = __builtin_shufflevector(c, c, 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7);
    return __builtin_shufflevector(ab, cc, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 16, 17, 18, 19, 20, 21);
  }

  /// The types of sixteen cells as numbers.
  static Sixteen types_of(std::uint64_t first, std::uint64_t second) {
    using Bytes [[gnu::vector_size(16)]] = std::uint8_t;
    using Words [[gnu::vector_size(64)]] = std::int32_t;
    const std::uint64_t both[2] = {first, second};
    Bytes bytes;
    std::memcpy(&bytes, both, sizeof(bytes));
    return __builtin_convertvector(__builtin_convertvector(bytes, Words), Sixteen);
  }

  FluidGrid<Real>& grid_;
  const BlockIndex index_;
  const Parity parity_;
};

}  // namespace lahar::lbm
