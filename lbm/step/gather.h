#pragma once
// Loading and storing the populations of a block seen through an offset of one cell. Rows of 8 cells run along x: an
// offset along x takes 7 cells from one row and 1 from the next block's. Where the rows lie is found once per block; a
// row is then two loads and a shuffle, or a shuffle and two masked stores.
#include <cstring>
#include <experimental/simd>
#include <tuple>
#include <utility>

#include "lbm/step/streaming.h"

namespace lahar::lbm {

namespace stdx = std::experimental;

/// The 8 numbers of a row.
template <class Real>
using Row = stdx::simd<Real, stdx::simd_abi::deduce_t<Real, kBlockWidth>>;

/// Rows for the compiler's own shuffles, which the library lacks.
template <class Real, int kRows>
struct RowsOf {
  using type [[gnu::vector_size(kRows * kBlockWidth * sizeof(Real))]] = Real;
};

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

/// Writes the chosen lanes and touches no others, which may be in use by another thread.
template <class Real, class V, class Mask>
[[gnu::always_inline]] inline void store_some(Real* p, const V& values, const Mask& chosen) {
  if constexpr (stdx::native_simd<float>::size() >= kBlockWidth)
    stdx::where(chosen, values).copy_to(p, stdx::element_aligned);
  else  // narrow vectors store with masks around the cache
    for (std::size_t k = 0; k < V::size(); ++k)
      if (chosen[k]) p[k] = values[k];
}

/// The numbers of one velocity in the blocks that a block seen through the offset (CX, CY, CZ) reaches into, loaded and
/// stored by one row of cells or two.
template <int CX, int CY, int CZ, class Real>
class ShiftedVelocity {
 public:
  static_assert(CX == 0 || CX == 1, "forward velocities");

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
      return value<V>(row(from[beyond_y(rows)], rows.n));
    } else if constexpr (CY == 0) {
      const auto near = vector<Two>(from[0][0] + rows.n);
      if constexpr (CX == 0) return value<V>(near);
      return value<V>(__builtin_shufflevector(near, vector<Two>(from[0][1] + rows.n), 1, 2, 3, 4, 5, 6, 7, 16, 9, 10,
                                              11, 12, 13, 14, 15, 24));
    } else {
      const auto first = row(from[CY < 0 && beyond_y(rows)], rows.n);
      const auto second = row(from[CY > 0 && beyond_y(rows)], rows.n + kBlockWidth);
      return value<V>(__builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    }
  }

  /// Stores the chosen cells of one row.
  template <class Mask>
  [[gnu::always_inline]] void store_chosen(const Rows& rows, const Row<Real>& values, const Mask& chosen) const {
    const auto& to = to_[beyond_z(rows)][beyond_y(rows)];
    if constexpr (CX == 0) {
      store_some(to[0] + rows.n, values, chosen);
    } else {
      Row<Real> flags(0);
      stdx::where(chosen, flags) = Row<Real>(1);
      const auto turn = [](const Row<Real>& v) __attribute__((always_inline)) {
        const auto own = vector<One>(v);
        return value<Row<Real>>(__builtin_shufflevector(own, own, 7, 0, 1, 2, 3, 4, 5, 6));
      };
      const Row<Real> lane([](auto k) { return static_cast<Real>(k); }), turned = turn(values);
      const auto wanted = turn(flags) > Row<Real>(0);
      store_some(to[0] + rows.n, turned, wanted && lane != Row<Real>(0));
      store_some(to[1] + rows.n, turned, wanted && lane == Row<Real>(0));
    }
  }

  /// The reverse of load.
  template <class V>
  [[gnu::always_inline]] void store(const Rows& rows, const V& values) const {
    const auto& to = to_[beyond_z(rows)];
    if constexpr (V::size() == kBlockWidth) {
      put_row(to[beyond_y(rows)], rows.n, vector<One>(values));
    } else if constexpr (CY == 0) {
      const auto own = vector<Two>(values);
      if constexpr (CX == 0)
        put(to[0][0] + rows.n, own);
      else
        put_ahead<V>(to[0][0] + rows.n, to[0][1] + rows.n,
                     __builtin_shufflevector(own, own, 7, 0, 1, 2, 3, 4, 5, 6, 15, 8, 9, 10, 11, 12, 13, 14));
    } else {
      const auto own = vector<Two>(values);
      put_row(to[CY < 0 && beyond_y(rows)], rows.n, __builtin_shufflevector(own, own, 0, 1, 2, 3, 4, 5, 6, 7));
      put_row(to[CY > 0 && beyond_y(rows)], rows.n + kBlockWidth,
              __builtin_shufflevector(own, own, 8, 9, 10, 11, 12, 13, 14, 15));
    }
  }

 private:
  using One = typename RowsOf<Real, 1>::type;
  using Two = typename RowsOf<Real, 2>::type;

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
    const auto near = vector<One>(from[0] + n);
    if constexpr (CX == 0) return near;
    return __builtin_shufflevector(near, vector<One>(from[1] + n), 1, 2, 3, 4, 5, 6, 7, 8);
  }

  [[gnu::always_inline]] static void put_row(Real* const (&to)[2], int n, const One& own) {
    if constexpr (CX == 0)
      put(to[0] + n, own);
    else
      put_ahead<Row<Real>>(to[0] + n, to[1] + n, __builtin_shufflevector(own, own, 7, 0, 1, 2, 3, 4, 5, 6));
  }

  /// Rows turned by one cell: the first number of each belongs into the far block, the others into the near one. What
  /// is not written may be in use by another thread and must not be touched, not even with its own value.
  template <class V, class Vector>
  [[gnu::always_inline]] static void put_ahead(Real* near, Real* far, const Vector& turned) {
    const V lane([](auto k) { return static_cast<Real>(k % kBlockWidth); }), values = value<V>(turned);
    store_some(near, values, lane != V(0));
    store_some(far, values, lane == V(0));
  }

  template <class Vector>
  [[gnu::always_inline]] static Vector vector(const Real* p) {
    Vector v;
    std::memcpy(&v, p, sizeof(v));
    return v;
  }

  template <class Vector, class Abi>
  [[gnu::always_inline]] static Vector vector(const stdx::simd<Real, Abi>& values) {
    Vector v;
    values.copy_to(reinterpret_cast<Real*>(&v), stdx::vector_aligned);
    return v;
  }

  template <class V, class Vector>
  [[gnu::always_inline]] static V value(const Vector& v) {
    return V(reinterpret_cast<const Real*>(&v), stdx::vector_aligned);
  }

  template <class Vector>
  [[gnu::always_inline]] static void put(Real* p, const Vector& v) {
    std::memcpy(p, &v, sizeof(v));
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
