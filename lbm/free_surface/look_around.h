#pragma once
// Fills what the interface cells of a block see (surroundings.h), a row of cells at a time.

#include "lbm/free_surface/surroundings.h"
#include "lbm/grid/fluid_grid.h"
#include "lbm/grid/row_types.h"
#include "lbm/step/row_moments.h"

namespace lahar::lbm {

/// What a missing block holds.
alignas(64) inline constexpr CellType kNoCells[kBlockCells] = {};
inline constexpr std::uint8_t kNoneCovered[kBlockCells / kBlockWidth] = {};

template <class Real>
class LookAround {
 public:
  LookAround(FluidGrid<Real>& grid, BlockIndex b, Parity parity) : grid_(grid), index_(b), parity_(parity) {}

  /// `rows` (bit y + 8 z) hold interface cells.
  void run(std::uint64_t rows, Surroundings<Real>& s) {
    const auto needed = rows_around(rows);
    const unsigned columns = columns_of(rows);
    const std::array<bool, 3> sides{(columns & 0x03U) != 0, true, (columns & 0xC0U) != 0};
    for (int bz = -1; bz <= 1; ++bz)
      for (int by = -1; by <= 1; ++by) see_rows(s, by, bz, needed, sides);
  }

 private:
  /// A row and two cells to either side, in a vector of sixteen.
  using Sixteen = Pack<Real, 2 * kBlockWidth>;

  /// A block that is looked into.
  struct View {
    const CellType* type = kNoCells;  ///< gas where there is no block
    const std::uint8_t* covered = kNoneCovered;
    const Real *fill_level = kRest<Real>, *density = kRest<Real>;
    BlockIndex block = kNoBlock;  ///< where its densities are asked for
    bool keeps_density = false;
  };

  /// Columns x of the interface cells, as bits.
  unsigned columns_of(std::uint64_t rows) const {
    unsigned columns = 0;
    for (; rows != 0; rows &= rows - 1) columns |= interface_cells(grid_.block(index_), std::countr_zero(rows));
    return columns;
  }

  /// The rows in the blocks at (-1..1, by, bz). Densities on a side that no interface cell looks at may be missing.
  void see_rows(Surroundings<Real>& s, int by, int bz, const std::array<std::uint32_t, 12>& needed,
                const std::array<bool, 3>& sides) const {
    constexpr int first[3] = {-2, 0, 8}, end[3] = {0, 8, 10};
    const std::uint32_t band = (1U << (end[by + 1] + 2)) - (1U << (first[by + 1] + 2));
    std::array<View, 3> views;
    bool known = false;
    for (int z = first[bz + 1]; z < end[bz + 1]; ++z) {
      std::uint32_t rows = needed[static_cast<std::size_t>(z + 2)] & band;
      if (rows == 0) continue;
      if (!known)
        for (int bx = -1; bx <= 1; ++bx) {
          const auto k = static_cast<std::size_t>(bx + 1);
          views[k] = view(neighbour_slot(bx, by, bz), sides[k]);
        }
      known = true;
      for (; rows != 0; rows &= rows - 1) see_row(s, std::countr_zero(rows) - 2, z, views);
    }
  }

  View view(int slot, bool asked) const {
    const Block<Real>* block = grid_.around(index_)[static_cast<std::size_t>(slot)];
    View v;
    if (!block) return v;
    v.type = block->type.data();
    if (block->body) v.covered = block->body->covered.data();
    if (block->surface) {
      v.fill_level = block->surface->fill_level;
      v.density = block->surface->density, v.keeps_density = true;
    }
    if (asked) v.block = grid_.topology().neighbours(index_)[static_cast<std::size_t>(slot)];
    return v;
  }

  [[gnu::always_inline]] void see_row(Surroundings<Real>& s, int y, int z, const std::array<View, 3>& views) const {
    const int first = cell_index(0, y & 7, z & 7);
    std::uint64_t types[3];
    for (std::size_t k = 0; k < 3; ++k) std::memcpy(&types[k], views[k].type + first, sizeof(types[k]));
    const Types seen{types[0] >> 48 | types[1] << 16, types[1] >> 48 | types[2] << 16};
    const int place = Surroundings<Real>::at(-2, y, z);
    const Sixteen zero(0), one(1), half(Real(0.5));
    const unsigned wet = seen.wet(), interface = seen.interface();
    s.wet.set_row(y, z, wet), s.interface.set_row(y, z, interface), s.empty.set_row(y, z, seen.empty());
    const auto covered = [&](std::size_t k) { return unsigned{views[k].covered[first / kBlockWidth]}; };
    s.covered.set_row(y, z, covered(0) >> 6 | covered(1) << 2 | (covered(2) & 3U) << 10);
    if (wet == 0) return store(s.full + place, zero);
    alignas(64) Real now[3][kBlockWidth], half_way[3][kBlockWidth];
    Densities row[3];
    for (std::size_t k = 0; k < 3; ++k) row[k] = densities(views[k], types[k], first, now[k], half_way[k]);
    store(s.density + place, row_and_sides(row[0].now, row[1].now, row[2].now));
    store(s.half_way + place, row_and_sides(row[0].half_way, row[1].half_way, row[2].half_way));
    using Lanes = typename Sixteen::mask_type;
    const Sixteen liquid = select(Lanes::from_bits(wet), one, zero);
    if (interface == 0) return store(s.full + place, liquid);
    const Sixteen fill =
        row_and_sides(views[0].fill_level + first, views[1].fill_level + first, views[2].fill_level + first);
    store(s.full + place, select(Lanes::from_bits(interface), half * fill, liquid));
  }

  /// What a row of a block is seen to hold: the numbers of its own fields, or of buffers.
  struct Densities {
    const Real *now, *half_way;
  };

  /// The sweep keeps no density of blocks without a surface: it is computed. Of cells of liquid half a step on it is
  /// the mean of all that they send and get (docs/decisions/0089).
  [[gnu::always_inline]] Densities densities(const View& v, std::uint64_t types, int first, Real (&now)[kBlockWidth],
                                             Real (&half_way)[kBlockWidth]) const {
    if (v.block == kNoBlock || (wet_cells(types) & ~interface_cells(types)) == 0)
      return {v.density + first, v.density + first};
    store_aligned(half_way, density_half_a_step_on(grid_.around(v.block), first, parity_));
    if (v.keeps_density) return {v.density + first, half_way};
    store_aligned(now, outgoing_density(grid_.around(v.block), first, parity_));
    return {now, half_way};
  }

  /// The last two numbers of a row, a row, the first two of another, and four that are of no use.
  [[gnu::always_inline]] static Sixteen row_and_sides(const Real* left, const Real* here, const Real* right) {
    const auto a = load<Row<Real>>(left), b = load<Row<Real>>(here), c = load<Row<Real>>(right);
    const Sixteen ab = shuffle<6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0, 0, 0, 0, 0, 0>(a, b);
    const Sixteen cc = shuffle<0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7>(c);
    return shuffle<0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 16, 17, 18, 19, 20, 21>(ab, cc);
  }

  /// The types of a row and two cells to either side, one to a byte; more in the upper half of the second word.
  struct Types {
    std::uint64_t first, second;
    unsigned wet() const { return kTwelve & (wet_cells(first) | wet_cells(second) << 8); }
    unsigned interface() const { return kTwelve & (interface_cells(first) | interface_cells(second) << 8); }
    unsigned empty() const { return kTwelve & (empty_cells(first) | empty_cells(second) << 8); }
    static constexpr unsigned kTwelve = 0xFFFU;
  };

  FluidGrid<Real>& grid_;
  const BlockIndex index_;
  const Parity parity_;
};

}  // namespace lahar::lbm
