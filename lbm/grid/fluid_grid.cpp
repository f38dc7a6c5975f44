#include "lbm/grid/fluid_grid.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/parallel.h"
#include "lbm/collision/stress_limit.h"
#include "lbm/grid/block_geometry.h"
#include "lbm/grid/cell_set.h"
#include "lbm/grid/row_types.h"

namespace lahar::lbm {

template <class Real>
FluidGrid<Real>::FluidGrid(DomainSpec spec, double velocity_to_lu)
    : domain_(std::move(spec)), velocity_to_lu_(velocity_to_lu), topology_(domain_.period()) {}

template <class Real>
BlockIndex FluidGrid<Real>::require_block(const Vec3i& coordinate) {
  if (const BlockIndex found = topology_.find(coordinate); found != kNoBlock) return found;
  const BlockIndex b = topology_.insert(coordinate);
  make_blocks({b});
  return b;
}

template <class Real>
void FluidGrid<Real>::require_blocks(const std::vector<Vec3i>& coordinates) {
  make_blocks(topology_.insert_missing(coordinates));
}

/// Storage and geometry of blocks that the topology knows.
template <class Real>
void FluidGrid<Real>::make_blocks(const std::vector<BlockIndex>& made) {
  if (topology_.capacity() > blocks_.size()) {
    blocks_.resize(topology_.capacity(), nullptr);
    around_.resize(topology_.capacity());
    has_surface_.resize(topology_.capacity(), 0);
    has_walls_.resize(topology_.capacity(), 0);
  }
  for (const BlockIndex b : made) {
    Block<Real>* const fresh = block_pool_.acquire();
    fresh->populations = population_pool_.acquire();
    fresh->birth = ++births_;
    blocks_[static_cast<std::size_t>(b)] = fresh;
  }
  for (const BlockIndex b : made) link_block(b);
  parallel_for(0, made.size(), 1, [&](std::size_t k) {
    Block<Real>& fresh = block(made[k]);
    for (int i = 0; i < D3Q19::q; ++i) std::memset(fresh.f(i), 0, kBlockCells * sizeof(Real));
    fresh.surface = nullptr;
    fresh.body = nullptr;
    fresh.impulse = nullptr;
    fresh.wet_cells = 0;
    fresh.wet_rows = 0;
    cut_geometry(fresh, domain_, lowest_cell(made[k]), velocity_to_lu_);
    has_walls_[static_cast<std::size_t>(made[k])] = !fresh.walls.cells.empty();
  });
}

namespace {

/// Whether links lead to the same walls, met in the same places, and what they send comes back from the same cells.
bool same_walls(const WallLinks& a, const WallLinks& b) {
  return a.directions == b.directions &&
         std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(),
                    [](const WallCell& c, const WallCell& d) {
                      return c.cell == d.cell && c.wall == d.wall && c.first_link == d.first_link &&
                             c.links == d.links && c.slip == d.slip && c.distance == d.distance && c.normal == d.normal;
                    }) &&
         std::equal(a.rows.begin(), a.rows.end(), b.rows.begin(), b.rows.end(),
                    [](const RowLink& c, const RowLink& d) {
                      return c.row == d.row && c.direction == d.direction && c.along == d.along &&
                             c.source == d.source && c.cells == d.cells;
                    }) &&
         std::equal(a.hits.begin(), a.hits.end(), b.hits.begin(), b.hits.end(),
                    [](const WallHit& h, const WallHit& k) { return h.share == k.share; });
}

}  // namespace

template <class Real>
std::vector<BlockIndex> FluidGrid<Real>::open_walls_by(double time) {
  std::vector<BlockIndex> changed;
  if (!domain_.open_walls_by(time)) return changed;
  std::vector<std::uint8_t> differs(owned().size(), 0);
  parallel_for(0, owned().size(), 1, [&](std::size_t k) {
    const BlockIndex b = owned()[k];
    Block<Real>& own = block(b);
    const auto types = own.type;
    if (!has_walls(b) && std::find(types.begin(), types.end(), CellType::wall) == types.end()) return;
    WallLinks links;
    std::swap(links, own.walls);
    cut_geometry(own, domain_, lowest_cell(b), velocity_to_lu_);
    for (std::size_t n = 0; n < types.size(); ++n)
      if (is_wet(types[n])) own.type[n] = types[n];
    differs[k] = own.type != types || !same_walls(own.walls, links);
    if (differs[k] == 0) std::swap(links, own.walls);  // what the last reflection noted of them stays
    has_walls_[static_cast<std::size_t>(b)] = !own.walls.cells.empty();
  });
  for (std::size_t k = 0; k < differs.size(); ++k)
    if (differs[k] != 0) changed.push_back(owned()[k]);
  return changed;
}

template <class Real>
void FluidGrid<Real>::set_velocity_to_lu(double velocity_to_lu) {
  velocity_to_lu_ = velocity_to_lu;
  for (const BlockIndex b : owned())
    if (has_walls(b)) block(b).walls.set_velocities(velocity_to_lu);
}

/// Tells a block and its neighbours of each other.
template <class Real>
void FluidGrid<Real>::link_block(BlockIndex b) {
  Block<Real>* const fresh = blocks_[static_cast<std::size_t>(b)];
  const auto& neighbours = topology_.neighbours(b);
  for (std::size_t slot = 0; slot < 27; ++slot) {
    const BlockIndex other = neighbours[slot];
    around_[static_cast<std::size_t>(b)][slot] = other == kNoBlock ? nullptr : blocks_[static_cast<std::size_t>(other)];
    if (other != kNoBlock) around_[static_cast<std::size_t>(other)][26 - slot] = fresh;
  }
}

template <class Real>
std::uint32_t FluidGrid<Real>::missing_around(CellPlace place) const {
  const auto p = cell_position(place.cell);
  const auto side = [&](std::size_t a) { return std::array<bool, 3>{p[a] == 0, true, p[a] == kBlockWidth - 1}; };
  return slots_within({side(0), side(1), side(2)}) & missing_neighbours(place.block);
}

template <class Real>
std::uint32_t FluidGrid<Real>::missing_neighbours(BlockIndex b) const {
  const auto& neighbours = topology_.neighbours(b);
  std::uint32_t missing = 0;
  for (std::size_t slot = 0; slot < 27; ++slot)
    missing |= static_cast<std::uint32_t>(neighbours[slot] == kNoBlock) << slot;
  return missing;
}

template <class Real>
void FluidGrid<Real>::require_neighbours(CellPlace place) {
  if (const std::uint32_t missing = missing_around(place); missing != 0) {
    std::vector<Vec3i> wanted;
    add_coordinates(place.block, missing, wanted);
    require_blocks(wanted);
  }
}

template <class Real>
void FluidGrid<Real>::add_coordinates(BlockIndex b, std::uint32_t slots, std::vector<Vec3i>& coordinates) const {
  for (; slots != 0; slots &= slots - 1) {
    const int slot = std::countr_zero(slots);
    coordinates.emplace_back(topology_.coordinate(b) + Vec3i(slot / 9 - 1, slot / 3 % 3 - 1, slot % 3 - 1));
  }
}

template <class Real>
void FluidGrid<Real>::release(BlockIndex b) {
  release_surface(b);
  release_body(b);
  Block<Real>& gone = block(b);
  const auto& neighbours = topology_.neighbours(b);
  for (std::size_t slot = 0; slot < 27; ++slot)
    if (neighbours[slot] != kNoBlock) around_[static_cast<std::size_t>(neighbours[slot])][26 - slot] = nullptr;
  population_pool_.release(gone.populations);
  gone.walls.clear();
  block_pool_.release(&gone);
  blocks_[static_cast<std::size_t>(b)] = nullptr;
  topology_.erase(b);
}

template <class Real>
SurfaceFields<Real>& FluidGrid<Real>::require_surface(BlockIndex b) {
  if (!block(b).surface) acquire_surface(b), clear_surface(b);
  return *block(b).surface;
}

template <class Real>
void FluidGrid<Real>::acquire_surface(BlockIndex b) {
  block(b).surface = surface_pool_.acquire();
  has_surface_[static_cast<std::size_t>(b)] = 1;
}

template <class Real>
void FluidGrid<Real>::clear_surface(BlockIndex b) {
  const Block<Real>& blk = block(b);
  SurfaceFields<Real>& s = *blk.surface;
  for (std::size_t n = 0; n < kBlockCells; ++n) {
    s.mass[n] = 0;
    s.density[n] = 0;
    s.largest_rate[n] = Real(kLargestRate);
    s.fill_level[n] = blk.type[n] == CellType::liquid ? Real(1) : Real(0);
  }
  s.count = 0;
  s.rows = 0;
  s.exposed = 0;
}

template <class Real>
BodyFields<Real>& FluidGrid<Real>::require_body(BlockIndex b) {
  Block<Real>& blk = block(b);
  if (!blk.body) {
    blk.body = body_pool_.acquire();
    std::memset(static_cast<void*>(blk.body), 0, sizeof(BodyFields<Real>));
  }
  return *blk.body;
}

template <class Real>
void FluidGrid<Real>::release_surface(BlockIndex b) {
  if (block(b).surface) surface_pool_.release(block(b).surface);
  block(b).surface = nullptr;
  has_surface_[static_cast<std::size_t>(b)] = 0;
}

template <class Real>
ImpulseFields<Real>& FluidGrid<Real>::require_impulse(BlockIndex b) {
  Block<Real>& blk = block(b);
  if (!blk.impulse) {
    require_body(b);
    blk.impulse = impulse_pool_.acquire();
    std::memset(static_cast<void*>(blk.impulse), 0, sizeof(ImpulseFields<Real>));
    with_impulse_.push_back(b);
  }
  return *blk.impulse;
}

template <class Real>
void FluidGrid<Real>::release_impulses() {
  for (const BlockIndex b : with_impulse_)
    if (exists(b)) release_impulse(b);
  with_impulse_.clear();
}

template <class Real>
void FluidGrid<Real>::release_impulse(BlockIndex b) {
  if (block(b).impulse) impulse_pool_.release(block(b).impulse);
  block(b).impulse = nullptr;
}

template <class Real>
void FluidGrid<Real>::release_body(BlockIndex b) {
  release_impulse(b);
  if (block(b).body) body_pool_.release(block(b).body);
  block(b).body = nullptr;
}

template <class Real>
void FluidGrid<Real>::list_cells(BlockIndex b) {
  Block<Real>& blk = block(b);
  blk.wet_cells = 0;
  blk.wet_rows = 0;
  std::uint64_t interface_rows = 0;
  std::size_t interfaces = 0;
  for (int row = 0; row < 64; ++row) {
    const unsigned wet = wet_cells(blk, row);
    if (wet == 0) continue;
    blk.wet_cells += std::popcount(wet);
    blk.wet_rows |= std::uint64_t{1} << row;
    unsigned cells = interface_cells(blk, row);
    if (cells == 0) continue;
    interface_rows |= std::uint64_t{1} << row;
    for (; cells != 0; cells &= cells - 1)
      blk.surface->cells[interfaces++] = static_cast<std::uint16_t>(kBlockWidth * row + std::countr_zero(cells));
  }
  if (!blk.surface) return;
  blk.surface->count = static_cast<int>(interfaces);
  blk.surface->rows = interface_rows;
  std::fill_n(blk.surface->largest_rate, kBlockCells, Real(kLargestRate));  // rows without interface cells keep it
}

template <class Real>
std::size_t FluidGrid<Real>::bytes() const {
  return population_pool_.bytes() + block_pool_.bytes() + surface_pool_.bytes() + body_pool_.bytes() +
         impulse_pool_.bytes();
}

template class FluidGrid<float>;
template class FluidGrid<double>;

}  // namespace lahar::lbm
