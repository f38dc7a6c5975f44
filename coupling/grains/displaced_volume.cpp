// Compiled without contraction of products and sums, as grain_volumes.cpp is.
#include "coupling/grains/displaced_volume.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "coupling/grains/sphere_rows.h"
#include "lbm/free_surface/covered_cells.h"
#include "lbm/free_surface/isolated_liquid.h"
#include "lbm/grid/row_types.h"
#include "lbm/step/row_moments.h"

namespace lahar::coupling {

using lbm::Block;
using lbm::BlockIndex;
using lbm::CellType;
using lbm::kBlockWidth;

namespace {

/// What share of a full cell's grains the cells of a block hold: none in gas.
template <class Real>
struct HeldShare {
  alignas(64) Real held[lbm::kBlockCells];

  /// All of them in wet cells; or, where they fill with the level, what there is of water.
  HeldShare(const Block<Real>& block, bool fills_with_level) {
    for (int row = 0; row < kRows; ++row) {
      const auto cells = Row<Real>::mask_type::from_bits(lbm::wet_cells(block, row));
      store_aligned(held + kBlockWidth * row,
                    fills_with_level ? water_in(block, row) : select(cells, Row<Real>(1), Row<Real>(0)));
    }
  }

 private:
  static constexpr int kRows = lbm::kBlockCells / kBlockWidth;
};

/// What the interface cells of a block hold for grains that do not cover them: 1, what is missing to a full cell, and
/// their liquid, lu. 0 elsewhere.
template <class Real>
struct SurfaceLiquid {
  alignas(64) Real surface[lbm::kBlockCells]{}, room[lbm::kBlockCells]{}, liquid[lbm::kBlockCells]{};
  bool any_open = false;
  bool any_covered = false;  ///< there are interface cells that a grain covers

  explicit SurfaceLiquid(const Block<Real>& block) {
    if (!block.surface) return;
    const Row<Real> one(1), none(0);
    for (std::uint64_t rows = block.surface->rows; rows != 0; rows &= rows - 1) {
      const int row = std::countr_zero(rows), n = kBlockWidth * row;
      const unsigned interface = lbm::interface_cells(block, row);
      const unsigned covered = block.body ? block.body->covered[static_cast<std::size_t>(row)] : 0U;
      any_covered = any_covered || (interface & covered) != 0;
      any_open = any_open || (interface & ~covered) != 0;
      const auto open = Row<Real>::mask_type::from_bits(interface & ~covered);
      const auto mass = load_aligned<Row<Real>>(block.surface->mass + n);
      const auto density = load_aligned<Row<Real>>(block.surface->density + n);
      const auto solid = block.body ? load_aligned<Row<Real>>(block.body->solid_fraction + n) : none;
      store_aligned(surface + n, select(open, one, none));
      store_aligned(room + n, select(open, max(none, one + density - mass), none));
      store_aligned(liquid + n, select(open, max(none, mass - solid), none));
    }
  }
};

/// Velocity of the interface cells of a block, lu.
template <class Real>
struct SurfaceVelocity {
  alignas(64) Real u[3][lbm::kBlockCells];

  SurfaceVelocity(const lbm::Fluid<Real>& fluid, BlockIndex b) {
    for (std::uint64_t rows = fluid.grid().block(b).surface->rows; rows != 0; rows &= rows - 1) {
      const int n = kBlockWidth * std::countr_zero(rows);
      const auto moments = lbm::outgoing_moments_of_row(fluid.grid().around(b), n, fluid.parity());
      for (int a = 0; a < 3; ++a) store_aligned(u[a] + n, moments.u[a]);
    }
  }
};

/// Volume of a sphere in the wet cells of a block. By copy, so that the sphere stays in registers.
template <class Real>
double wet_volume_in(const GridSphere<Real> sphere, const Vec3i& lowest, const HeldShare<Real>& cells) {
  Row<Real> wet(0);
  for_covered_rows(
      sphere, lowest, [&](int row, const Row<Real>& eps) __attribute__((always_inline)) {
        wet += eps * load_aligned<Row<Real>>(cells.held + row);
      });
  return sum_in_double(wet);
}

/// All sums of eps times what the cells hold over the rows of a block that a sphere covers.
template <class Real, class Share>
void measure_rows(const GridSphere<Real> sphere, const Vec3i& lowest, const HeldShare<Real>& cells,
                  const SurfaceLiquid<Real>& open, Share& share) {
  Row<Real> wet(0), surface(0), room(0), liquid(0);
  for_covered_rows(
      sphere, lowest, [&](int row, const Row<Real>& eps) __attribute__((always_inline)) {
        wet += eps * load_aligned<Row<Real>>(cells.held + row);
        surface += eps * load_aligned<Row<Real>>(open.surface + row);
        room += eps * load_aligned<Row<Real>>(open.room + row);
        liquid += eps * load_aligned<Row<Real>>(open.liquid + row);
      });
  share.wet = sum_in_double(wet), share.surface = sum_in_double(surface);
  share.room = sum_in_double(room), share.liquid = sum_in_double(liquid);
}

}  // namespace

template <class Real>
void DisplacedVolume<Real>::measure_former(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map) {
  make_room_for(map);
  if (!fills_with_level_) measure_again(fluid, map);
  parallel_for(0, map.grains().size(), 256, [&](std::size_t k) {
    const MappedGrain& g = map.grains()[k];
    const auto first = map.pairs().begin() + static_cast<std::ptrdiff_t>(g.first_pair), last = first + g.pairs;
    Former& former = former_[g.id];
    former = {wet_volume_of(g), lbm::kNoBlock};
    double most = 0;
    for (auto p = first; p != last; ++p)
      if (const double wet = shares_[static_cast<std::size_t>(p - map.pairs().begin())].wet;
          wet > most && map.is_alive(fluid, *p))
        most = wet, former.block = p->block;
  });
}

/// The shares of the former mapping in the wet cells of now.
template <class Real>
void DisplacedVolume<Real>::measure_again(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map) {
  shares_.resize(map.pairs().size());
  map.by_block().for_each_block([&](std::size_t index) {
    const auto pairs = map.by_block().in(index);
    const auto b = static_cast<BlockIndex>(index);
    const Block<Real>* const block = fluid.grid().exists(b) ? &fluid.grid().block(b) : nullptr;
    const bool whole = block && block->wet_cells == lbm::kBlockCells;
    std::optional<HeldShare<Real>> cells;
    if (block && !whole) cells.emplace(*block, false);
    for (const std::uint32_t k : pairs) {
      const GrainInBlock& pair = map.pairs()[k];
      shares_[k] = {};
      if (!map.is_alive(fluid, pair)) continue;
      if (whole)
        shares_[k].wet = pair.volume;
      else
        shares_[k].wet = wet_volume_in<Real>(map.sphere(pair.grain), pair.lowest, *cells);
    }
  });
}

template <class Real>
void DisplacedVolume<Real>::begin(const GrainMap<Real>& map) {
  make_room_for(map);
  shares_.resize(map.pairs().size());
}

/// Grains are mapped in the order of their ids.
template <class Real>
void DisplacedVolume<Real>::make_room_for(const GrainMap<Real>& map) {
  if (map.grains().empty()) return;
  former_.resize(std::max(former_.size(), std::size_t{map.grains().back().id} + 1));
}

template <class Real>
void DisplacedVolume<Real>::measure_block(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t index) {
  const Block<Real>& block = fluid.grid().block(static_cast<BlockIndex>(index));
  const auto pairs = map.by_block().in(index);
  for (const std::uint32_t k : pairs) shares_[k] = {.wet = map.pairs()[k].volume};
  if (block.wet_cells == lbm::kBlockCells && !block.surface) return;
  const HeldShare<Real> cells(block, fills_with_level_);
  const SurfaceLiquid<Real> open(block);
  for (const std::uint32_t k : pairs) {
    const GrainInBlock& pair = map.pairs()[k];
    const GridSphere<Real>& sphere = map.sphere(pair.grain);
    if (open.any_open)
      measure_rows<Real>(sphere, pair.lowest, cells, open, shares_[k]);
    else
      shares_[k].wet = wet_volume_in<Real>(sphere, pair.lowest, cells);
    if (open.any_covered) settle_covered(block, sphere, pair.lowest, shares_[k]);
  }
}

template <class Real>
double DisplacedVolume<Real>::wet_volume_of(const MappedGrain& grain) const {
  double sum = 0;
  for (std::size_t p = grain.first_pair; p < grain.first_pair + grain.pairs; ++p) sum += shares_[p].wet;
  return sum;
}

template <class Real>
auto DisplacedVolume<Real>::handed_by(const MappedGrain& grain) const -> Handed {
  Handed sum;
  for (std::size_t p = grain.first_pair; p < grain.first_pair + grain.pairs; ++p)
    sum.mass += shares_[p].handed.mass, sum.momentum += shares_[p].handed.momentum;
  return sum;
}

/// Interface cells that a grain covers hold what they are whole; what they gained or lost goes to the grain's others.
template <class Real>
void DisplacedVolume<Real>::settle_covered(const Block<Real>& block, const GridSphere<Real>& sphere,
                                           const Vec3i& lowest, Share& share) {
  for_covered_rows(sphere, lowest, [&](int row, const Row<Real>& eps) {
    for (int c = 0; c < kBlockWidth; ++c) {
      const int cell = row + c;
      if (block.type[static_cast<std::size_t>(cell)] != CellType::interface || !lbm::is_covered(block, cell) ||
          eps[static_cast<std::size_t>(c)] <= 0)
        continue;
      Real& mass = block.surface->mass[cell];
      const Real whole = Real(1) + block.surface->density[cell];
      share.drift += static_cast<double>(mass) - static_cast<double>(whole);
      mass = whole;
    }
  });
}

/// Interface cells get in proportion to the room that they have, or to their liquid where it is taken, lest a cell that
/// stands full above the surface be filled again and again (docs/decisions/0045). Where that is not enough all of them
/// get alike, and where they are too few the cells near by.
template <class Real>
void DisplacedVolume<Real>::book(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map) {
  const auto& grains = map.grains();
  handouts_.assign(grains.size(), {}), isolated_.assign(grains.size(), 0.0);
  parallel_for(0, grains.size(), 256, [&](std::size_t k) {
    const MappedGrain& g = grains[k];
    Former& former = former_[g.id];
    double change = -former.wet, surface = 0, room = 0, liquid = 0, wet = 0;
    former.wet = 0;
    for (std::size_t p = g.first_pair; p < g.first_pair + g.pairs; ++p) {
      const Share& share = shares_[p];
      change += share.wet + share.drift;
      surface += share.surface, room += share.room, liquid += share.liquid;
      wet += share.wet;
    }
    if (change == 0) return;
    const double able = change > 0 ? room : liquid;
    Handout& handout = handouts_[k];
    handout.alike = !(able > std::abs(change));
    if (!handout.alike)
      handout.per_able = change / able;
    else if (surface > std::abs(change))
      handout.per_able = change / surface;
    else if (wet > 0)
      isolated_[k] = change / wet;
    else
      former.wet = -change;  // it has dried, or left the blocks: as if it were removed
  });
  fluid.account().released = 0;  // it is in what the grains changed by
  isolated_in_.assign(fluid.grid().topology().capacity(), 0.0);
  map.by_block().for_each_block([&](std::size_t block) {
    hand_out(fluid, map, block);
    for (const std::uint32_t k : map.by_block().in(block))
      isolated_in_[block] += isolated_[map.pairs()[k].grain] * shares_[k].wet;
  });
  for (Former& gone : former_) {
    if (gone.block != lbm::kNoBlock)
      isolated_in_[static_cast<std::size_t>(gone.block)] -= gone.wet;
    else
      lbm::send_to_pool(-gone.wet, fluid.account());
    gone = {};
  }
  lbm::pay_nearby(fluid.grid(), isolated_in_, fluid.account());
}

template <class Real>
void DisplacedVolume<Real>::hand_out(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t index) {
  Block<Real>& block = fluid.grid().block(static_cast<BlockIndex>(index));
  if (!block.surface) return;
  const auto pairs = map.by_block().in(index);
  if (std::none_of(pairs.begin(), pairs.end(),
                   [&](std::uint32_t k) { return handouts_[map.pairs()[k].grain].per_able != 0; }))
    return;
  const SurfaceLiquid<Real> cells(block);  // each grain looks at what the cells had before
  if (!cells.any_open) return;
  std::optional<SurfaceVelocity<Real>> velocity;
  if (fills_with_level_) velocity.emplace(fluid, static_cast<BlockIndex>(index));
  alignas(64) std::array<Real, lbm::kBlockCells> gain{};  // of all grains: rounded once where it is added
  for (const std::uint32_t k : pairs) {
    const GrainInBlock& pair = map.pairs()[k];
    const Handout& handout = handouts_[pair.grain];
    if (handout.per_able == 0) continue;
    const Row<Real> per_able(static_cast<Real>(handout.per_able));
    const Real* const able = handout.alike ? cells.surface : handout.per_able > 0 ? cells.room : cells.liquid;
    Row<Real> mass(0), momentum[3]{Row<Real>(0), Row<Real>(0), Row<Real>(0)};
    for_covered_rows(
        map.sphere(pair.grain), pair.lowest, [&](int row, const Row<Real>& eps) __attribute__((always_inline)) {
          const Row<Real> part = per_able * (eps * load_aligned<Row<Real>>(able + row));
          add_to_row(gain.data() + row, part);
          if (!velocity || !(block.surface->rows >> (row / kBlockWidth) & 1)) return;
          mass += part;
          const auto some = part != Row<Real>(0);
          for (int a = 0; a < 3; ++a)
            momentum[a] += select(some, part * load_aligned<Row<Real>>(velocity->u[a] + row), Row<Real>(0));
        });
    if (velocity)
      shares_[k].handed = {sum_in_double(mass),
                           {sum_in_double(momentum[0]), sum_in_double(momentum[1]), sum_in_double(momentum[2])}};
  }
  for (std::size_t n = 0; n < gain.size(); n += kBlockWidth)
    add_to_row(block.surface->mass + n, load_aligned<Row<Real>>(gain.data() + n));
}

/// Where grains do not fill with the level all else is measured again.
template <class Real>
void DisplacedVolume<Real>::transfer(Archive& archive) {
  if (!fills_with_level_) return;
  std::size_t pairs = shares_.size();
  archive.value("pairs", pairs);
  shares_.resize(pairs);
  archive.pieces<double>("wet", pairs, 1, [&](std::size_t k, double* stored) {
    if (archive.loading())
      shares_[k].wet = *stored;
    else
      *stored = shares_[k].wet;
  });
}

template class DisplacedVolume<float>;
template class DisplacedVolume<double>;

}  // namespace lahar::coupling
