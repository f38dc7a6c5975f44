#pragma once
// A set of cells of a block as 512 bits, values for such cells, and who is next to them. A
// plane of 8 x 8 cells is one word, bit x + 8 y. Sets are sparse: what is done with them goes by their cells.
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "lbm/grid/cells.h"

namespace lahar::lbm {

class CellSet {
 public:
  void add(int cell) {
    planes_[static_cast<std::size_t>(cell >> 6)] |= std::uint64_t{1} << (cell & 63);
    occupied_ |= 1U << (cell >> 6);
  }
  void remove(int cell) {
    std::uint64_t& plane = planes_[static_cast<std::size_t>(cell >> 6)];
    plane &= ~(std::uint64_t{1} << (cell & 63));
    if (plane == 0) occupied_ &= ~(1U << (cell >> 6));
  }
  void add_all(const CellSet& other) {
    for (std::size_t z = 0; z < planes_.size(); ++z) planes_[z] |= other.planes_[z];
    occupied_ |= other.occupied_;
  }
  void clear() { *this = {}; }

  [[nodiscard]] bool has(int cell) const { return plane(cell >> 6) >> (cell & 63) & 1; }
  [[nodiscard]] bool empty() const { return occupied_ == 0; }
  [[nodiscard]] int count() const { return count_in(occupied_); }
  /// Number of cells of the set before this one.
  [[nodiscard]] int rank(int cell) const {
    return std::popcount(plane(cell >> 6) & ((std::uint64_t{1} << (cell & 63)) - 1)) +
           count_in(occupied_ & ((1U << (cell >> 6)) - 1));
  }
  /// Calls visit(cell) in ascending order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (unsigned planes = occupied_; planes != 0; planes &= planes - 1) {
      const int z = std::countr_zero(planes);
      for (std::uint64_t cells = plane(z); cells != 0; cells &= cells - 1) visit(64 * z + std::countr_zero(cells));
    }
  }
  /// The neighbour blocks (bits by neighbour_slot, itself included) that neighbours of the cells may lie in.
  [[nodiscard]] std::uint32_t reach() const;

  /// The cells next to the neighbour block at a slot; all for the block itself.
  [[nodiscard]] CellSet facing(int slot) const;

  bool operator==(const CellSet&) const = default;

 private:
  [[nodiscard]] std::uint64_t plane(int z) const { return planes_[static_cast<std::size_t>(z)]; }
  /// Cells in some planes, by bit z; plane by plane, since GCC 12 counts wrong where it counts several at once.
  [[nodiscard]] int count_in(unsigned planes) const {
    int n = 0;
    for (; planes != 0; planes &= planes - 1) n += std::popcount(plane(std::countr_zero(planes)));
    return n;
  }

  std::array<std::uint64_t, kBlockWidth> planes_{};
  unsigned occupied_ = 0;
};

/// The neighbour blocks within a cell of some sides: per axis whether the low side, none, or the high side is reached.
inline std::uint32_t slots_within(const std::array<std::array<bool, 3>, 3>& sides) {
  std::uint32_t slots = 0;
  for (std::size_t x = 0; x < 3; ++x)
    for (std::size_t y = 0; y < 3; ++y)
      for (std::size_t z = 0; z < 3; ++z)
        if (sides[0][x] && sides[1][y] && sides[2][z]) slots |= std::uint32_t{1} << (9 * x + 3 * y + z);
  return slots;
}

inline std::uint32_t CellSet::reach() const {
  if (occupied_ == 0) return 0;
  std::uint64_t all = 0;
  for (const std::uint64_t p : planes_) all |= p;
  constexpr std::uint64_t first_column = 0x0101010101010101U, first_row = 0xFFU;
  return slots_within({{{(all & first_column) != 0, true, (all & first_column << 7) != 0},
                        {(all & first_row) != 0, true, (all & first_row << 56) != 0},
                        {(occupied_ & 1U) != 0, true, (occupied_ >> 7 & 1U) != 0}}});
}

inline CellSet CellSet::facing(int slot) const {
  constexpr std::uint64_t all = ~std::uint64_t{0}, columns = 0x0101010101010101U, rows = 0xFFU;
  constexpr std::uint64_t sides_x[3] = {columns, all, columns << 7}, sides_y[3] = {rows, all, rows << 56};
  constexpr unsigned sides_z[3] = {1U, 0xFFU, 0x80U};
  const std::uint64_t cells = sides_x[slot / 9] & sides_y[slot / 3 % 3];
  CellSet near;
  for (unsigned planes = occupied_ & sides_z[slot % 3]; planes != 0; planes &= planes - 1) {
    const int z = std::countr_zero(planes);
    if (const std::uint64_t p = plane(z) & cells; p != 0)
      near.planes_[static_cast<std::size_t>(z)] = p, near.occupied_ |= 1U << z;
  }
  return near;
}

/// Values for some cells of a block, in the order of the cells.
template <class T>
class CellMap {
 public:
  /// The cell must have none yet.
  void add(int cell, T value) {
    values_.insert(values_.begin() + cells_.rank(cell), std::move(value));
    cells_.add(cell);
  }
  /// The same after all cells that are in.
  void append(int cell, T value) {
    values_.push_back(std::move(value));
    cells_.add(cell);
  }
  void clear() {
    if (cells_.empty()) return;
    cells_.clear(), values_.clear();
  }
  [[nodiscard]] const CellSet& cells() const { return cells_; }
  [[nodiscard]] bool empty() const { return cells_.empty(); }
  [[nodiscard]] const T& at(int cell) const { return values_[static_cast<std::size_t>(cells_.rank(cell))]; }
  [[nodiscard]] const T* find(int cell) const { return cells_.has(cell) ? &at(cell) : nullptr; }
  /// Calls visit(cell, value) in the order of the cells.
  template <class Visit>
  void for_each(const Visit& visit) {
    auto value = values_.begin();
    cells_.for_each([&](int cell) { visit(cell, *value++); });
  }
  template <class Visit>
  void for_each(const Visit& visit) const {
    auto value = values_.begin();
    cells_.for_each([&](int cell) { visit(cell, *value++); });
  }

 private:
  CellSet cells_;
  std::vector<T> values_;
};

/// Directions (bits by velocity) that lead from a cell into the block at a slot. What counts of the cell is at which
/// sides of its block it lies: per axis 0 at the low side, 2 at the high one, else 1.
constexpr std::array<std::array<std::uint32_t, 27>, 27> directions_into_blocks() {
  std::array<std::array<std::uint32_t, 27>, 27> directions{};
  for (std::size_t sides = 0; sides < 27; ++sides) {
    const std::size_t side[3] = {sides / 9, sides / 3 % 3, sides % 3};
    for (int i = 1; i < D3Q19::q; ++i) {
      int d[3] = {0, 0, 0};
      for (int a = 0; a < 3; ++a) {
        const int c = D3Q19::c[i][a];
        if ((c < 0 && side[a] == 0) || (c > 0 && side[a] == 2)) d[a] = c;
      }
      directions[sides][static_cast<std::size_t>(neighbour_slot(d[0], d[1], d[2]))] |= std::uint32_t{1} << i;
    }
  }
  return directions;
}
inline constexpr auto kDirectionsInto = directions_into_blocks();

/// Calls visit(neighbour) for the neighbours of a cell that lie in the block at a slot, in the order of the velocities.
template <class Visit>
void for_each_neighbour_in(int cell, int slot, const Visit& visit) {
  constexpr std::size_t side[kBlockWidth] = {0, 1, 1, 1, 1, 1, 1, 2};
  const std::size_t sides = 9 * side[cell & 7] + 3 * side[cell >> 3 & 7] + side[cell >> 6];
  for (std::uint32_t i = kDirectionsInto[sides][static_cast<std::size_t>(slot)]; i != 0; i &= i - 1)
    visit(kNeighbours.cell(std::countr_zero(i), cell));
}

}  // namespace lahar::lbm
