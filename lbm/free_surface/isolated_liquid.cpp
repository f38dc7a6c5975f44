#include "lbm/free_surface/isolated_liquid.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "lbm/free_surface/touching.h"

namespace lahar::lbm {

namespace {

constexpr double kLargestDose = 0.02;  ///< to one cell in a step
constexpr double kIdle = 1e-5;         ///< a smaller pool waits: payments would drown in rounding

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

}  // namespace

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

template double pay_isolated_liquid<float>(FluidGrid<float>&, const std::vector<BlockIndex>&, double, std::uint64_t);
template double pay_isolated_liquid<double>(FluidGrid<double>&, const std::vector<BlockIndex>&, double, std::uint64_t);

}  // namespace lahar::lbm
