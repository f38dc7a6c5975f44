#include "lbm/free_surface/isolated_liquid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/parallel.h"
#include "lbm/free_surface/touching.h"

namespace lahar::lbm {

namespace {

constexpr double kLargestDose = 0.02;  ///< to one cell in a step
constexpr double kIdle = 1e-5;         ///< less waits in the pool: payments would drown in rounding
constexpr double kRounding = 1e-9;     ///< less is owed by a block only since sums are rounded

/// A stretch of the line of what the cells can take, and what of it lies beyond the end and so at the beginning.
struct Stretch {
  double first, last, wrapped;

  [[nodiscard]] double part_of(double low, double high) const {
    return std::max(0.0, std::min(high, last) - std::max(low, first)) + std::max(0.0, std::min(high, wrapped) - low);
  }
};

/// What a cell can take, or give (pool < 0).
template <class Real>
double room_of(const Block<Real>& block, int cell, bool gives) {
  return gives ? std::min(kLargestDose, static_cast<double>(liquid_of(block, cell))) : kLargestDose;
}

template <class Real, class Visit>
void for_each_interface_cell(const Block<Real>& block, const Visit& visit) {
  for (int c = 0; c < block.surface->count; ++c) visit(block.surface->cells[static_cast<std::size_t>(c)]);
}

template <class Real>
double pay_block(Block<Real>& block, const Stretch& stretch, double place, bool gives) {
  double paid = 0;
  for_each_interface_cell(block, [&](int cell) {
    const double room = room_of(block, cell, gives), dose = stretch.part_of(place, place + room);
    place += room;
    if (dose <= 0) return;
    Real& mass = block.surface->mass[cell];
    const Real before = mass;
    mass += static_cast<Real>(gives ? -dose : dose);
    paid += static_cast<double>(mass) - static_cast<double>(before);
  });
  return paid;
}

/// The same for what is paid nearby: bodies' own cells are no liquid, and full ones have no room.
template <class Real>
double nearby_room_of(const Block<Real>& block, int cell, bool gives) {
  if (is_covered(block, cell)) return 0;
  const Real missing = Real(1) + block.surface->density[cell] - block.surface->mass[cell];
  return gives ? room_of(block, cell, true) : std::clamp(static_cast<double>(missing), 0.0, kLargestDose);
}

template <class Real>
double nearby_room_in(const Block<Real>& block, bool gives) {
  double room = 0;
  if (block.surface) for_each_interface_cell(block, [&](int cell) { room += nearby_room_of(block, cell, gives); });
  return room;
}

/// Pays `liquid` to the interface cells of a block in proportion to their room, as far as that goes; returns what was
/// paid, as the cells stored it.
template <class Real>
double pay_alike(Block<Real>& block, double liquid) {
  const bool gives = liquid < 0;
  const double room = nearby_room_in(block, gives);
  if (room == 0) return 0;
  const double part = std::clamp(liquid / room, -1.0, 1.0);
  double paid = 0;
  for_each_interface_cell(block, [&](int cell) {
    Real& mass = block.surface->mass[cell];
    const Real before = mass;
    mass += static_cast<Real>(part * nearby_room_of(block, cell, gives));
    paid += static_cast<double>(mass) - static_cast<double>(before);
  });
  return paid;
}

/// What blocks are asked to pay, lu by block index, and which they are, in the order in which they were asked.
struct Asked {
  std::vector<double> liquid;
  std::vector<BlockIndex> blocks;

  explicit Asked(std::size_t capacity) : liquid(capacity, 0.0), known_(capacity, false) {}
  void add(BlockIndex b, double mass) {
    const auto index = static_cast<std::size_t>(b);
    if (!known_[index]) known_[index] = true, blocks.push_back(b);
    liquid[index] += mass;
  }

 private:
  std::vector<bool> known_;
};

/// Asks the blocks around one in proportion to their room, as far as that goes; returns what was asked.
template <class Real>
double ask_around(const FluidGrid<Real>& grid, BlockIndex b, double liquid, Asked& asked) {
  const auto& around = grid.topology().neighbours(b);
  std::array<double, 27> rooms{};
  double room = 0;
  for (std::size_t slot = 0; slot < rooms.size(); ++slot) {
    const BlockIndex other = around[slot];
    if (other == kNoBlock || other == b || !grid.has_surface(other)) continue;
    rooms[slot] = nearby_room_in(grid.block(other), liquid < 0), room += rooms[slot];
  }
  if (room == 0) return 0;
  const double part = std::clamp(liquid / room, -1.0, 1.0);
  for (std::size_t slot = 0; slot < rooms.size(); ++slot)
    if (rooms[slot] > 0) asked.add(around[slot], part * rooms[slot]);
  return part * room;
}

/// Each of `blocks` pays what `liquid` has for it, in parallel; returns what they did not, in their order.
template <class Real>
std::vector<double> pay_blocks(FluidGrid<Real>& grid, const std::vector<BlockIndex>& blocks,
                               const std::vector<double>& liquid, LiquidAccount& account) {
  std::vector<double> rests(blocks.size());
  parallel_for(0, blocks.size(), 4, [&](std::size_t k) {
    const double owed = liquid[static_cast<std::size_t>(blocks[k])];
    rests[k] = owed - pay_alike(grid.block(blocks[k]), owed);
  });
  for (std::size_t k = 0; k < blocks.size(); ++k)
    account.paid_nearby += std::abs(liquid[static_cast<std::size_t>(blocks[k])] - rests[k]);
  return rests;
}

}  // namespace

template <class Real>
void pay_nearby(FluidGrid<Real>& grid, const std::vector<double>& liquid, LiquidAccount& account) {
  std::vector<BlockIndex> blocks;
  for (const BlockIndex b : grid.owned()) {
    const double owed = static_cast<std::size_t>(b) < liquid.size() ? liquid[static_cast<std::size_t>(b)] : 0;
    if (std::abs(owed) > kRounding)
      blocks.push_back(b);
    else
      account.pool += owed;
  }
  if (blocks.empty()) return;
  const std::vector<double> rests = pay_blocks(grid, blocks, liquid, account);
  std::optional<Asked> asked;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    double rest = rests[k];
    if (std::abs(rest) > kIdle) {
      if (!asked) asked.emplace(grid.topology().capacity());
      rest -= ask_around(grid, blocks[k], rest, *asked);
    }
    send_to_pool(rest, account);
  }
  if (!asked) return;
  for (const double rest : pay_blocks(grid, asked->blocks, asked->liquid, account)) send_to_pool(rest, account);
}

template <class Real>
double pay_isolated_liquid(FluidGrid<Real>& grid, const std::vector<BlockIndex>& blocks, double pool,
                           std::uint64_t round) {
  if (std::abs(pool) <= kIdle) return 0;
  const bool gives = pool < 0;
  std::vector<double> rooms(blocks.size(), 0.0), places(blocks.size(), 0.0), paid(blocks.size(), 0.0);
  parallel_for(0, blocks.size(), 16, [&](std::size_t k) {
    const Block<Real>& block = grid.block(blocks[k]);
    for_each_interface_cell(block, [&](int cell) { rooms[k] += room_of(block, cell, gives); });
  });
  double line = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k) places[k] = line, line += rooms[k];
  const double first = drop_draw(round) * line, length = std::min(std::abs(pool), line);
  const Stretch stretch{first, std::min(line, first + length), first + length - line};
  parallel_for(0, blocks.size(), 16, [&](std::size_t k) {
    if (stretch.part_of(places[k], places[k] + rooms[k]) > 0)
      paid[k] = pay_block(grid.block(blocks[k]), stretch, places[k], gives);
  });
  double sum = 0;
  for (const double p : paid) sum += p;
  return sum;
}

template void pay_nearby<float>(FluidGrid<float>&, const std::vector<double>&, LiquidAccount&);
template void pay_nearby<double>(FluidGrid<double>&, const std::vector<double>&, LiquidAccount&);
template double pay_isolated_liquid<float>(FluidGrid<float>&, const std::vector<BlockIndex>&, double, std::uint64_t);
template double pay_isolated_liquid<double>(FluidGrid<double>&, const std::vector<BlockIndex>&, double, std::uint64_t);

}  // namespace lahar::lbm
