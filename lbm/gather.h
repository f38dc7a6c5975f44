#pragma once
// Moving the populations of one velocity between a block, seen through an offset of one cell, and a contiguous buffer.
// Rows of 8 cells run along x: an offset along x takes 7 cells from one row and 1 from the next block's. A layer of 8
// rows is moved as a whole: where it lies is found once per block, so that a row is two loads, a shuffle and a store.
#include <cstring>
#include <experimental/simd>
#include <tuple>
#include <utility>

#include "lbm/streaming.h"

namespace lahar::lbm {

namespace stdx = std::experimental;

/// The 8 numbers of a row.
template <class Real>
using Row = stdx::simd<Real, stdx::simd_abi::deduce_t<Real, kBlockWidth>>;

/// The same for the compiler's own shuffles, which the library lacks.
template <class Real>
struct NativeRow {
  using type [[gnu::vector_size(kBlockWidth * sizeof(Real))]] = Real;
};

/// A row of 8 cells, number y + 8 z of a block, seen through an offset along y and z: the blocks that hold it and its
/// first cell there.
struct ShiftedRow {
  int slot_y, slot_z;  ///< -1..1, offset of the block
  int first;           ///< first cell of the row in that block
};

template <int CY, int CZ>
[[gnu::always_inline]] constexpr ShiftedRow shifted_row(int row) {
  const int y = (row & 7) + CY, z = (row >> 3) + CZ;
  return {y < 0 ? -1 : (y > 7 ? 1 : 0), z < 0 ? -1 : (z > 7 ? 1 : 0), cell_index(0, y & 7, z & 7)};
}

/// Where a velocity's numbers of a shifted row lie; null where the block is missing.
template <class Real>
[[gnu::always_inline]] inline Real* row_of(const std::array<Block<Real>*, 27>& around, int dx, const ShiftedRow& row,
                                           int slot) {
  const Block<Real>* block = around[static_cast<std::size_t>(neighbour_slot(dx, row.slot_y, row.slot_z))];
  return block ? block->f(slot) + row.first : nullptr;
}

/// The numbers of one velocity in the blocks that a block seen through the offset (CX, CY, CZ) reaches into.
template <int CX, int CY, int CZ, class Real>
class ShiftedVelocity {
 public:
  static_assert(CX == 0 || CX == 1, "forward velocities");

  /// A missing block reads as `zeros` (rest at density 1); what is sent there goes to `nowhere`. Both of 512 numbers.
  ShiftedVelocity(const std::array<Block<Real>*, 27>& around, int slot, const Real* zeros, Real* nowhere) {
    for (int kz = 0; kz < 2; ++kz)
      for (int ky = 0; ky < 2; ++ky)
        for (int kx = 0; kx < 2; ++kx) {
          const Block<Real>* block = around[static_cast<std::size_t>(neighbour_slot(kx * CX, ky * CY, kz * CZ))];
          from_[kz][ky][kx] = block ? block->f(slot) : zeros;
          to_[kz][ky][kx] = block ? block->f(slot) : nowhere;
        }
  }

  /// buffer[n] = number at n + (CX, CY, CZ) for the 64 cells n of layer z.
  [[gnu::always_inline]] void gather(int z, Real* __restrict buffer) const {
    const int beyond = z + CZ < 0 || z + CZ > 7, first = kLayer * ((z + CZ) & 7);
    for_rows([&]<int Y>() __attribute__((always_inline)) {
      constexpr int next = Y + CY < 0 || Y + CY > 7;
      const int row = first + kBlockWidth * ((Y + CY) & 7);
      const Real* near = from_[beyond][next][0] + row;
      if constexpr (CX == 0) {
        std::memcpy(buffer + kBlockWidth * Y, near, sizeof(Native));
      } else {
        const Native shifted =
            __builtin_shufflevector(load(near), load(from_[beyond][next][1] + row), 1, 2, 3, 4, 5, 6, 7, 8);
        std::memcpy(buffer + kBlockWidth * Y, &shifted, sizeof(Native));
      }
    });
  }

  /// The number at n + (CX, CY, CZ) = buffer[n] for the 64 cells n of layer z.
  [[gnu::always_inline]] void scatter(int z, const Real* __restrict buffer) const {
    const int beyond = z + CZ < 0 || z + CZ > 7, first = kLayer * ((z + CZ) & 7);
    for_rows([&]<int Y>() __attribute__((always_inline)) {
      constexpr int next = Y + CY < 0 || Y + CY > 7;
      const int row = first + kBlockWidth * ((Y + CY) & 7);
      Real* near = to_[beyond][next][0] + row;
      if constexpr (CX == 0) {
        std::memcpy(near, buffer + kBlockWidth * Y, sizeof(Native));
      } else {
        // The first number of the row ahead belongs to the block beside this one: it must not be written, not even with
        // its own value.
        const Native own = load(buffer + kBlockWidth * Y);
        const Native turned = __builtin_shufflevector(own, own, 7, 0, 1, 2, 3, 4, 5, 6);
        const Row<Real> values(reinterpret_cast<const Real*>(&turned), stdx::element_aligned);
        stdx::where(not_first(), values).copy_to(near, stdx::element_aligned);
        to_[beyond][next][1][row] = turned[0];
      }
    });
  }

 private:
  using Native = typename NativeRow<Real>::type;
  static constexpr int kLayer = kBlockWidth * kBlockWidth;

  template <class Visit>
  [[gnu::always_inline]] static void for_rows(const Visit& visit) {
    [&]<std::size_t... Y>(std::index_sequence<Y...>) __attribute__((always_inline)) {
      (visit.template operator()<static_cast<int>(Y)>(), ...);
    }
    (std::make_index_sequence<kBlockWidth>{});
  }

  [[gnu::always_inline]] static Native load(const Real* p) {
    Native v;
    std::memcpy(&v, p, sizeof(v));
    return v;
  }

  [[gnu::always_inline]] static auto not_first() {
    const Row<Real> lane([](auto k) { return static_cast<Real>(k); });
    return lane > Row<Real>(0);
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
  static constexpr int layer = kBlockWidth * kBlockWidth;  ///< cells

  /// `zeros` and `nowhere`: see ShiftedVelocity.
  AwayPopulations(const std::array<Block<Real>*, 27>& around, Parity parity, const Real* zeros, Real* nowhere)
      : velocities_(make(around, parity, zeros, nowhere, std::make_index_sequence<D3Q19::pairs>{})) {}

  /// The layers from z on that fill the buffer of each pair.
  template <std::size_t kCells>
  [[gnu::always_inline]] void gather(int z, Real (&buffer)[D3Q19::pairs][kCells]) const {
    for (int k = 0; k < static_cast<int>(kCells) / layer; ++k)
      for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
        std::get<P>(velocities_).gather(z + k, buffer[P] + layer * k);
      });
  }

  template <std::size_t kCells>
  [[gnu::always_inline]] void scatter(int z, const Real (&buffer)[D3Q19::pairs][kCells]) const {
    for (int k = 0; k < static_cast<int>(kCells) / layer; ++k)
      for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
        std::get<P>(velocities_).scatter(z + k, buffer[P] + layer * k);
      });
  }

 private:
  template <std::size_t P>
  using Velocity =
      ShiftedVelocity<D3Q19::c[2 * P + 1][0], D3Q19::c[2 * P + 1][1], D3Q19::c[2 * P + 1][2], Real>;

  template <std::size_t... P>
  static auto make(const std::array<Block<Real>*, 27>& around, Parity parity, const Real* zeros, Real* nowhere,
                   std::index_sequence<P...>) {
    return std::tuple(Velocity<P>(around, parity.away(D3Q19::forward(P)), zeros, nowhere)...);
  }

  decltype(make({}, {}, nullptr, nullptr, std::make_index_sequence<D3Q19::pairs>{})) velocities_;
};

}  // namespace lahar::lbm
