// Compiled without contraction of products and sums, as grain_volumes.cpp is.
#include "coupling/grains/displaced_volume.h"

#include "coupling/grains/sphere_rows.h"
#include "lbm/free_surface/covered_cells.h"
#include "lbm/free_surface/touching.h"

namespace lahar::coupling {

using lbm::Block;
using lbm::BlockIndex;
using lbm::CellType;
using lbm::kBlockWidth;

namespace {

/// What an interface cell lacks to be full, lu; not below 0.
template <class Real>
Real room_of(const Block<Real>& block, int cell) {
  return std::max(Real(0), Real(1) + block.surface->density[cell] - block.surface->mass[cell]);
}

/// Calls visit(cell, eps) for the cells of the rows of a block that a sphere covers.
template <class Real, class Visit>
[[gnu::always_inline]] inline void for_cells(const GridSphere<Real>& sphere, const Vec3i& lowest, const Visit& visit) {
  for_covered_rows(sphere, lowest, [&](int row, const Row<Real>& cover) {
    alignas(64) Real eps[kBlockWidth];
    store_aligned(eps, cover);
    for (int c = 0; c < kBlockWidth; ++c) visit(row + c, eps[c]);
  });
}

}  // namespace

template <class Real>
void DisplacedVolume<Real>::measure_former(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map) {
  make_room_for(map);
  parallel_for(0, map.grains().size(), 64, [&](std::size_t k) {
    const MappedGrain& g = map.grains()[k];
    double sum = 0;
    for (std::size_t p = g.first_pair; p < g.first_pair + g.pairs; ++p) {
      const GrainInBlock& pair = map.pairs()[p];
      if (!map.is_alive(fluid, pair)) continue;
      const Block<Real>& block = fluid.grid().block(pair.block);
      Share share{.wet = pair.volume};
      if (block.wet_cells < lbm::kBlockCells) measure_wet(block, map.sphere(k), pair.lowest, share);
      sum += share.wet;
    }
    former_wet_[g.id] = sum;
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
  former_wet_.resize(std::max(former_wet_.size(), std::size_t{map.grains().back().id} + 1), 0.0);
}

template <class Real>
void DisplacedVolume<Real>::measure_block(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t index) {
  const Block<Real>& block = fluid.grid().block(static_cast<BlockIndex>(index));
  const auto pairs = map.by_block().in(index);
  for (const std::uint32_t k : pairs) shares_[k] = {.wet = map.pairs()[k].volume};
  if (block.wet_cells == lbm::kBlockCells && !block.surface) return;
  for (const std::uint32_t k : pairs) {
    const GrainInBlock& pair = map.pairs()[k];
    measure_wet(block, map.sphere(pair.grain), pair.lowest, shares_[k]);
    if (block.surface) settle_covered(block, map.sphere(pair.grain), pair.lowest, shares_[k]);
  }
}

template <class Real>
void DisplacedVolume<Real>::end() {
  wet_volume_ = 0;
  for (const Share& share : shares_) wet_volume_ += share.wet;
}

template <class Real>
double DisplacedVolume<Real>::wet_volume_of(const MappedGrain& grain) const {
  double sum = 0;
  for (std::size_t p = grain.first_pair; p < grain.first_pair + grain.pairs; ++p) sum += shares_[p].wet;
  return sum;
}

template <class Real>
void DisplacedVolume<Real>::measure_wet(const Block<Real>& block, const GridSphere<Real>& sphere, const Vec3i& lowest,
                                        Share& share) {
  share = {};
  for_cells(sphere, lowest, [&](int cell, Real cover) {
    const CellType t = block.type[static_cast<std::size_t>(cell)];
    const auto eps = static_cast<double>(cover);
    if (lbm::is_wet(t)) share.wet += eps;
    if (t != CellType::interface || eps <= 0 || lbm::is_covered(block, cell)) return;
    share.surface += eps;
    share.room += eps * static_cast<double>(room_of(block, cell));
    share.liquid += eps * static_cast<double>(lbm::liquid_of(block, cell));
  });
}

/// Interface cells that a grain covers hold what they are whole; what they gained or lost goes to the grain's others.
template <class Real>
void DisplacedVolume<Real>::settle_covered(const Block<Real>& block, const GridSphere<Real>& sphere,
                                           const Vec3i& lowest, Share& share) {
  for_cells(sphere, lowest, [&](int cell, Real eps) {
    if (block.type[static_cast<std::size_t>(cell)] != CellType::interface || eps <= 0 || !lbm::is_covered(block, cell))
      return;
    Real& mass = block.surface->mass[cell];
    const Real whole = Real(1) + block.surface->density[cell];
    share.drift += static_cast<double>(mass) - static_cast<double>(whole);
    mass = whole;
  });
}

/// Interface cells get in proportion to the room that they have, or to their liquid where it is taken, lest a cell that
/// stands full above the surface be filled again and again (docs/decisions/0045). Where that is not enough all of them
/// get alike.
template <class Real>
void DisplacedVolume<Real>::book(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map) {
  const auto& grains = map.grains();
  handouts_.assign(grains.size(), {}), for_pool_.assign(grains.size(), 0.0);
  parallel_for(0, grains.size(), 256, [&](std::size_t k) {
    const MappedGrain& g = grains[k];
    double change = -former_wet_[g.id], surface = 0, room = 0, liquid = 0;
    former_wet_[g.id] = 0;
    for (std::size_t p = g.first_pair; p < g.first_pair + g.pairs; ++p) {
      const Share& share = shares_[p];
      change += share.wet + share.drift;
      surface += share.surface, room += share.room, liquid += share.liquid;
    }
    if (change == 0) return;
    const double able = change > 0 ? room : liquid;
    Handout& handout = handouts_[k];
    handout.alike = !(able > std::abs(change));
    if (!handout.alike)
      handout.per_able = change / able;
    else if (surface > std::abs(change))
      handout.per_able = change / surface;
    else
      for_pool_[k] = change;
  });
  for (double& wet : former_wet_)
    if (wet != 0) fluid.account().pool -= wet, wet = 0;
  for (const double change : for_pool_)
    if (change != 0) fluid.account().pool += change;
  map.by_block().for_each_block([&](std::size_t block) { hand_out(fluid, map, block); });
}

template <class Real>
void DisplacedVolume<Real>::hand_out(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t index) const {
  Block<Real>& block = fluid.grid().block(static_cast<BlockIndex>(index));
  if (!block.surface) return;
  alignas(64) std::array<Real, lbm::kBlockCells> gain{};  // of all grains: each looks at what the cells had before
  bool any = false;
  for (const std::uint32_t k : map.by_block().in(index)) {
    const GrainInBlock& pair = map.pairs()[k];
    const Handout& handout = handouts_[pair.grain];
    if (handout.per_able == 0) continue;
    any = true;
    const auto per_able = static_cast<Real>(handout.per_able);
    for_cells(map.sphere(pair.grain), pair.lowest, [&](int cell, Real eps) {
      if (block.type[static_cast<std::size_t>(cell)] != CellType::interface || eps <= 0 || lbm::is_covered(block, cell))
        return;
      const Real able = handout.alike ? Real(1) : per_able > 0 ? room_of(block, cell) : lbm::liquid_of(block, cell);
      Real& sum = gain[static_cast<std::size_t>(cell)];
      sum = multiply_add(per_able, eps * able, sum);
    });
  }
  if (!any) return;
  for (std::size_t cell = 0; cell < gain.size(); ++cell)
    if (gain[cell] != 0) block.surface->mass[cell] += gain[cell];
}

template class DisplacedVolume<float>;
template class DisplacedVolume<double>;

}  // namespace lahar::coupling
