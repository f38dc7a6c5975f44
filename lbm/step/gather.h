#pragma once
// Loading and storing the populations of a block seen through an offset of one cell. Rows of 8 cells run along x: an
// offset along x takes 7 cells from one row and 1 from the next block's. Where the rows lie is found once per block; a
// row is then two loads and a shuffle, or a shuffle and two masked stores.
#include <tuple>
#include <utility>

#include "core/simd.h"
#include "lbm/step/streaming.h"

namespace lahar::lbm {

static_assert(kRow == kBlockWidth);

/// One row of cells along x, or two, and where they lie in their block.
struct Rows {
  int n;                        ///< first cell
  std::size_t first_y, last_y;  ///< 1 if a row has y = 0 or 7
  std::size_t first_z, last_z;

  /// `count` rows from cell n on; y even for two.
  [[gnu::always_inline]] static Rows at(int n, int count) {
    const int y = (n / kBlockWidth) & 7, z = n / (kBlockWidth * kBlockWidth);
    return {n, y == 0, y + count == kBlockWidth, z == 0, z == kBlockWidth - 1};
  }
};

/// What a missing block holds: rest at density 1, shifted by the weights.
template <class Real>
alignas(64) inline constexpr Real kRest[kBlockCells] = {};

/// The numbers of one velocity in the blocks that a block seen through the offset (CX, CY, CZ) reaches into, loaded and
/// stored by one row of cells or two.
template <int CX, int CY, int CZ, class Real>
class ShiftedVelocity {
 public:
  static_assert(CX == 0 || CX == 1, "forward velocities");
  using One = Row<Real>;
  using Two = Pack<Real, 2 * kBlockWidth>;

  /// A missing block reads as rest at density 1; what is sent there goes to the 512 numbers at `nowhere`, which may be
  /// null if nothing is stored. The pointers are shifted so that the cell n + (CX, CY, CZ) lies at n, whichever block
  /// holds it.
  ShiftedVelocity(const std::array<Block<Real>*, 27>& around, int slot, Real* nowhere) {
    // Only what load and store look up: along an axis without an offset nothing lies beyond.
    for (int kz = 0; kz <= (CZ != 0); ++kz)
      for (int ky = 0; ky <= (CY != 0); ++ky)
        for (int kx = 0; kx <= CX; ++kx) {
          const Block<Real>* block = around[static_cast<std::size_t>(neighbour_slot(kx * CX, ky * CY, kz * CZ))];
          const int shift = cell_index(0, CY, CZ) - kBlockWidth * cell_index(0, ky * CY, kz * CZ);
          from_[kz][ky][kx] = shifted<const Real>(block ? block->f(slot) : kRest<Real>, shift);
          to_[kz][ky][kx] = shifted<Real>(block ? block->f(slot) : nowhere, shift);
        }
  }

  /// The numbers at n + (CX, CY, CZ) for the cells n of the rows.
  template <class V>
  [[gnu::always_inline]] V load(const Rows& rows) const {
    const auto& from = from_[beyond_z(rows)];
    if constexpr (V::size() == kBlockWidth) {
      return row(from[beyond_y(rows)], rows.n);
    } else if constexpr (CY == 0) {
      const auto near = lahar::load<Two>(from[0][0] + rows.n);
      if constexpr (CX == 0) return near;
      return shuffle<1, 2, 3, 4, 5, 6, 7, 16, 9, 10, 11, 12, 13, 14, 15, 24>(near,
                                                                             lahar::load<Two>(from[0][1] + rows.n));
    } else {
      return join(row(from[CY < 0 && beyond_y(rows)], rows.n),
                  row(from[CY > 0 && beyond_y(rows)], rows.n + kBlockWidth));
    }
  }

  /// Stores the chosen cells of one row.
  [[gnu::always_inline]] void store_chosen(const Rows& rows, const One& values,
                                           const typename One::mask_type& chosen) const {
    const auto& to = to_[beyond_z(rows)][beyond_y(rows)];
    if constexpr (CX == 0) {
      store_if(chosen, to[0] + rows.n, values);
    } else {
      const One turned = turn(values);
      store_if(One::mask_type::from_bits(chosen.bits() << 1 & kInNear<One>), to[0] + rows.n, turned);
      store_if(One::mask_type::from_bits(chosen.bits() >> (kBlockWidth - 1)), to[1] + rows.n, turned);
    }
  }

  /// The same for two rows.
  [[gnu::always_inline]] void store_chosen(const Rows& rows, const Two& values,
                                           const typename Two::mask_type& chosen) const {
    const Rows first = Rows::at(rows.n, 1), second = Rows::at(rows.n + kBlockWidth, 1);
    store_chosen(first, half_of<0>(values), One::mask_type::from_bits(chosen.bits() & One::mask_type::kAll));
    store_chosen(second, half_of<1>(values), One::mask_type::from_bits(chosen.bits() >> kBlockWidth));
  }

  /// The reverse of load.
  template <class V>
  [[gnu::always_inline]] void store(const Rows& rows, const V& values) const {
    const auto& to = to_[beyond_z(rows)];
    if constexpr (V::size() == kBlockWidth) {
      put_row(to[beyond_y(rows)], rows.n, values);
    } else if constexpr (CY == 0) {
      if constexpr (CX == 0)
        lahar::store(to[0][0] + rows.n, values);
      else
        put_ahead(to[0][0] + rows.n, to[0][1] + rows.n,
                  shuffle<7, 0, 1, 2, 3, 4, 5, 6, 15, 8, 9, 10, 11, 12, 13, 14>(values));
    } else {
      put_row(to[CY < 0 && beyond_y(rows)], rows.n, half_of<0>(values));
      put_row(to[CY > 0 && beyond_y(rows)], rows.n + kBlockWidth, half_of<1>(values));
    }
  }

 private:
  /// By way of an integer: the pointer may lie outside of what it is used in.
  template <class Number>
  static Number* shifted(Number* p, int cells) {
    return reinterpret_cast<Number*>(reinterpret_cast<std::intptr_t>(p) +
                                     static_cast<std::intptr_t>(sizeof(Real)) * cells);
  }

  [[gnu::always_inline]] static std::size_t beyond_y(const Rows& rows) {
    return CY == 0 ? 0 : (CY > 0 ? rows.last_y : rows.first_y);
  }
  [[gnu::always_inline]] static std::size_t beyond_z(const Rows& rows) {
    return CZ == 0 ? 0 : (CZ > 0 ? rows.last_z : rows.first_z);
  }

  [[gnu::always_inline]] static One row(const Real* const (&from)[2], int n) {
    const One near = lahar::load<One>(from[0] + n);
    if constexpr (CX == 0) return near;
    return shuffle<1, 2, 3, 4, 5, 6, 7, 8>(near, lahar::load<One>(from[1] + n));
  }

  [[gnu::always_inline]] static One turn(const One& values) { return shuffle<7, 0, 1, 2, 3, 4, 5, 6>(values); }

  [[gnu::always_inline]] static void put_row(Real* const (&to)[2], int n, const One& own) {
    if constexpr (CX == 0)
      lahar::store(to[0] + n, own);
    else
      put_ahead(to[0] + n, to[1] + n, turn(own));
  }

  /// Lanes of turned rows that belong into the near block: all but the first of each row.
  template <class V>
  static constexpr unsigned kInNear = 0xFEFEU & V::mask_type::kAll;

  /// Rows turned by one cell: the first number of each belongs into the far block, the others into the near one. What
  /// is not written may be in use by another thread and must not be touched, not even with its own value.
  template <class V>
  [[gnu::always_inline]] static void put_ahead(Real* near, Real* far, const V& turned) {
    using Lanes = typename V::mask_type;
    store_if(Lanes::from_bits(kInNear<V>), near, turned);
    store_if(Lanes::from_bits(~kInNear<V> & Lanes::kAll), far, turned);
  }

  const Real* from_[2][2][2];
  Real* to_[2][2][2];
};

/// Calls visit.template operator()<pair, CX, CY, CZ>() for the nine forward velocities.
template <class Visit>
[[gnu::always_inline]] inline void for_each_pair(const Visit& visit) {
  [&]<std::size_t... P>(std::index_sequence<P...>) __attribute__((always_inline)) {
    (visit.template
     operator()<static_cast<int>(P), D3Q19::c[2 * P + 1][0], D3Q19::c[2 * P + 1][1], D3Q19::c[2 * P + 1][2]>(),
     ...);
  }
  (std::make_index_sequence<D3Q19::pairs>{});
}

/// The nine forward velocities seen by the cells of one block.
template <class Real>
class AwayPopulations {
 public:
  /// `nowhere`: see ShiftedVelocity.
  AwayPopulations(const std::array<Block<Real>*, 27>& around, Parity parity, Real* nowhere)
      : velocities_(make(around, parity, nowhere, std::make_index_sequence<D3Q19::pairs>{})) {}

  template <int P>
  [[nodiscard]] const auto& pair() const {
    return std::get<P>(velocities_);
  }

 private:
  template <std::size_t P>
  using Velocity = ShiftedVelocity<D3Q19::c[2 * P + 1][0], D3Q19::c[2 * P + 1][1], D3Q19::c[2 * P + 1][2], Real>;

  template <std::size_t... P>
  static auto make(const std::array<Block<Real>*, 27>& around, Parity parity, Real* nowhere,
                   std::index_sequence<P...>) {
    return std::tuple(Velocity<P>(around, parity.away(D3Q19::forward(P)), nowhere)...);
  }

  decltype(make({}, {}, nullptr, std::make_index_sequence<D3Q19::pairs>{})) velocities_;
};

}  // namespace lahar::lbm
