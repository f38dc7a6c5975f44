#pragma once
// Fills what the interface cells of a block see (surroundings.h), a row of cells at a time.
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

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

  /// Densities half a step on, where what `run` has seen asks for them: in liquid two links away from interface cells
  /// that no body reaches. They take a sum over all that a cell sends and gets: few cells are asked for.
  void see_half_a_step_on(std::uint64_t rows, Surroundings<Real>& s) const {
    std::uint16_t asked[12][12] = {};  // by z + 2 and y + 2, bit x + 2
    for (; rows != 0; rows &= rows - 1) ask_two_links_away(std::countr_zero(rows), asked);
    for (int z = -2; z < 10; ++z)
      for (int y = -2; y < 10; ++y)
        if (const unsigned cells = asked[z + 2][y + 2]; cells != 0)
          see_half_a_step_on(cells & s.wet.all_of_row(y, z) & ~s.interface.all_of_row(y, z), y, z, s);
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

  /// Adds the cells two links away from the interface cells of a row that no body reaches.
  void ask_two_links_away(int row, std::uint16_t (&asked)[12][12]) const {
    const Block<Real>& block = grid_.block(index_);
    unsigned cells = interface_cells(block, row);
    if (block.body) cells &= ~(load<Row<Real>>(block.body->exchange_weight + kBlockWidth * row) > Row<Real>(0)).bits();
    if (cells == 0) return;
    const unsigned here = cells << 2, aside = here << 2 | here >> 2;
    for (int cz = 0; cz < 3; ++cz)
      for (int cy = 0; cy < 3; ++cy) {
        const int steps = (cz != 1) + (cy != 1);
        asked[(row >> 3) + 2 * cz][(row & 7) + 2 * cy] |= static_cast<std::uint16_t>(steps == 0   ? aside
                                                                                     : steps == 1 ? here | aside
                                                                                                  : here);
      }
  }

  /// Of the cells (bit x + 2) of one row.
  void see_half_a_step_on(unsigned cells, int y, int z, Surroundings<Real>& s) const {
    const int slot = neighbour_slot(0, y >> 3, z >> 3), first = cell_index(0, y & 7, z & 7);
    const auto densities = [&](int bx) {
      const BlockIndex b = grid_.topology().neighbours(index_)[static_cast<std::size_t>(slot + 9 * bx)];
      return density_half_a_step_on(grid_.around(b), first, parity_);
    };
    Real* const row = s.half_way + Surroundings<Real>::at(0, y, z);
    if ((cells & 0x3FCU) != 0) store(row, densities(0));
    if ((cells & 0x003U) != 0) {
      const Row<Real> left = densities(-1);
      row[-2] = left[6], row[-1] = left[7];
    }
    if ((cells & 0xC00U) != 0) {
      const Row<Real> right = densities(1);
      row[8] = right[0], row[9] = right[1];
    }
  }

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
    alignas(64) Real computed[3][kBlockWidth];
    const Real* drho[3];
    for (std::size_t k = 0; k < 3; ++k) drho[k] = densities(views[k], types[k], first, computed[k]);
    store(s.density + place, row_and_sides(drho[0], drho[1], drho[2]));
    using Lanes = typename Sixteen::mask_type;
    const Sixteen liquid = select(Lanes::from_bits(wet), one, zero);
    if (interface == 0) return store(s.full + place, liquid);
    const Sixteen fill =
        row_and_sides(views[0].fill_level + first, views[1].fill_level + first, views[2].fill_level + first);
    store(s.full + place, select(Lanes::from_bits(interface), half * fill, liquid));
  }

  /// Those of a row of a block: its own field, or the buffer. The sweep keeps no density of blocks without a surface:
  /// it is computed.
  [[gnu::always_inline]] const Real* densities(const View& v, std::uint64_t types, int first,
                                               Real (&computed)[kBlockWidth]) const {
    if (v.keeps_density || v.block == kNoBlock || wet_cells(types) == 0) return v.density + first;
    store_aligned(computed, outgoing_density(grid_.around(v.block), first, parity_));
    return computed;
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
