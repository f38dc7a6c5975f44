#include "lbm/grid/fluid_grid.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "lbm/boundary/row_reflection.h"
#include "lbm/collision/stress_limit.h"
#include "lbm/grid/row_types.h"

namespace lahar::lbm {

template <class Real>
FluidGrid<Real>::FluidGrid(DomainSpec spec, double velocity_to_lu)
    : domain_(std::move(spec)), velocity_to_lu_(velocity_to_lu), topology_(domain_.period()) {}

template <class Real>
BlockIndex FluidGrid<Real>::require_block(const Vec3i& coordinate) {
  if (const BlockIndex found = topology_.find(coordinate); found != kNoBlock) return found;
  const BlockIndex b = topology_.insert(coordinate);
  make_block(b);
  return b;
}

/// Storage and geometry of a block that the topology knows.
template <class Real>
void FluidGrid<Real>::make_block(BlockIndex b) {
  if (topology_.capacity() > blocks_.size()) {
    blocks_.resize(topology_.capacity(), nullptr);
    around_.resize(topology_.capacity());
    has_surface_.resize(topology_.capacity(), 0);
    has_walls_.resize(topology_.capacity(), 0);
  }
  Block<Real>* fresh = block_pool_.acquire();
  fresh->populations = population_pool_.acquire();
  for (int i = 0; i < D3Q19::q; ++i) std::memset(fresh->f(i), 0, kBlockCells * sizeof(Real));
  fresh->surface = nullptr;
  fresh->body = nullptr;
  fresh->impulse = nullptr;
  fresh->wet_cells = 0;
  fresh->wet_rows = 0;
  fresh->birth = ++births_;
  blocks_[static_cast<std::size_t>(b)] = fresh;
  const auto& neighbours = topology_.neighbours(b);
  for (std::size_t slot = 0; slot < 27; ++slot) {
    const BlockIndex other = neighbours[slot];
    around_[static_cast<std::size_t>(b)][slot] = other == kNoBlock ? nullptr : blocks_[static_cast<std::size_t>(other)];
    if (other != kNoBlock) around_[static_cast<std::size_t>(other)][26 - slot] = fresh;
  }
  cut_geometry(b);
  has_walls_[static_cast<std::size_t>(b)] = !fresh->walls.cells.empty();
}

template <class Real>
void FluidGrid<Real>::require_neighbours(CellPlace place) {
  const auto p = cell_position(place.cell);
  int low[3], high[3];
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = p[a] == 0 ? -1 : 0;
    high[a] = p[a] == 7 ? 1 : 0;
  }
  const Vec3i here = topology_.coordinate(place.block);
  for (int x = low[0]; x <= high[0]; ++x)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int z = low[2]; z <= high[2]; ++z)
        if (topology_.neighbours(place.block)[static_cast<std::size_t>(neighbour_slot(x, y, z))] == kNoBlock)
          require_block(here + Vec3i(x, y, z));
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
void FluidGrid<Real>::cut_geometry(BlockIndex b) {
  Block<Real>& fresh = block(b);
  fresh.walls.clear();
  const Vec3i lowest = lowest_cell(b);
  std::array<CellType, 1000> types;  // the block and one cell around it
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y)
      for (int z = 0; z < 10; ++z)
        types[static_cast<std::size_t>(100 * x + 10 * y + z)] = domain_.classify(lowest + Vec3i(x - 1, y - 1, z - 1));
  for (int n = 0; n < kBlockCells; ++n) {
    const auto p = cell_position(n);
    const auto at = [&](int i) {
      return types[static_cast<std::size_t>(100 * (p[0] + 1 + D3Q19::c[i][0]) + 10 * (p[1] + 1 + D3Q19::c[i][1]) +
                                            p[2] + 1 + D3Q19::c[i][2])];
    };
    const auto cell = static_cast<std::size_t>(n);
    fresh.type[cell] = at(0);
    fresh.at_rim[cell] = false;
    if (at(0) != CellType::gas) continue;
    for (int i = 1; i < D3Q19::q; ++i) fresh.at_rim[cell] = fresh.at_rim[cell] || at(i) == CellType::sink;
    add_wall_links(fresh, n, lowest + Vec3i(p[0], p[1], p[2]), types);
  }
  list_row_links(fresh.walls, types, domain_.placement());
}

namespace {

/// A link into the edge where a no-slip wall meets another one hits both of them there, and liquid may cross neither.
/// The push of a moving wall over its diagonal links is the liquid that it carries along from cell to cell; over the
/// link into the edge it would carry that through the other wall, u/6 a step in at one end and out at the other, which
/// takes as much from the circulation that the wall drives: an error of first order in the cell (docs/decisions/0038).
/// So such a link is the wall's that moves less along it; among walls at rest nothing changes.
void give_corner_links(const Domain& domain, const Vec3i& place, std::array<int, D3Q19::q>& wall_of) {
  const auto& walls = domain.walls().all();
  const auto link = [](int x, int y, int z) {
    for (std::size_t i = 0; i < D3Q19::q; ++i)
      if (D3Q19::c[i][0] == x && D3Q19::c[i][1] == y && D3Q19::c[i][2] == z) return i;
    return std::size_t{0};
  };
  for (std::size_t i = 1; i < D3Q19::q; ++i) {
    const auto* c = D3Q19::c[i];
    if (wall_of[i] < 0 || std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]) < 2) continue;
    const Vec3 way(c[0], c[1], c[2]), hit = domain.centre(place) + 0.5 * domain.cell_size() * way;
    const auto pace = [&](int wall) {
      return std::abs(walls[static_cast<std::size_t>(wall)].surface_velocity(hit).dot(way));
    };
    const int sides[3] = {wall_of[link(c[0], 0, 0)], wall_of[link(0, c[1], 0)], wall_of[link(0, 0, c[2])]};
    int meeting[2] = {-1, -1}, n = 0;
    for (int a = 0; a < 3; ++a)
      if (c[a] != 0) meeting[n++] = sides[a];
    if (meeting[0] < 0 || meeting[1] < 0 || meeting[0] == meeting[1]) continue;
    for (const int wall : meeting)
      if (walls[static_cast<std::size_t>(wall)].slip != WallSlip::wall_model &&
          walls[static_cast<std::size_t>(wall_of[i])].slip == WallSlip::no_slip && pace(wall) < pace(wall_of[i]))
        wall_of[i] = wall;
  }
}

}  // namespace

template <class Real>
void FluidGrid<Real>::add_wall_links(Block<Real>& fresh, int cell, const Vec3i& place,
                                     const std::array<CellType, 1000>& types) {
  const auto p = cell_position(cell);
  std::array<int, D3Q19::q> wall_of{};
  for (int i = 1; i < D3Q19::q; ++i) {
    const auto* c = D3Q19::c[i];
    const bool solid =
        types[static_cast<std::size_t>(100 * (p[0] + 1 + c[0]) + 10 * (p[1] + 1 + c[1]) + p[2] + 1 + c[2])] ==
        CellType::wall;
    wall_of[static_cast<std::size_t>(i)] =
        solid ? domain_.walls().nearest(domain_.centre(place + Vec3i(c[0], c[1], c[2]))).wall : -1;
  }
  wall_of[0] = -1;
  give_corner_links(domain_, place, wall_of);
  for (int wall = 0; wall < static_cast<int>(domain_.walls().all().size()); ++wall) {
    const auto links = std::count(wall_of.begin(), wall_of.end(), wall);
    if (links == 0) continue;
    const Wall& w = domain_.walls().all()[static_cast<std::size_t>(wall)];
    const Vec3 centre = domain_.centre(place),
               normal = domain_.walls().gradient(static_cast<std::size_t>(wall), centre);
    const Vec3 velocity = w.surface_velocity(centre) * velocity_to_lu_;
    WallCell entry{
        static_cast<std::uint16_t>(cell),
        static_cast<std::uint16_t>(fresh.walls.directions.size()),
        static_cast<std::uint8_t>(links),
        w.slip,
        {},
        {},
        static_cast<float>(domain_.walls().distance(static_cast<std::size_t>(wall), centre) / domain_.cell_size()),
        static_cast<float>(w.roughness / domain_.cell_size()),
        static_cast<std::int16_t>(wall)};
    for (int a = 0; a < 3; ++a) {
      entry.normal[static_cast<std::size_t>(a)] = static_cast<float>(normal[a]);
      entry.wall_velocity[static_cast<std::size_t>(a)] = static_cast<float>(velocity[a]);
    }
    Vec3 sum = Vec3::Zero();
    for (int i = 1; i < D3Q19::q; ++i)
      if (wall_of[static_cast<std::size_t>(i)] == wall)
        sum += D3Q19::w(i) * Vec3(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
    entry.even = (sum - sum.dot(normal) * normal).norm() < 1e-6;
    fresh.walls.cells.push_back(entry);
    for (int i = 1; i < D3Q19::q; ++i)
      if (wall_of[static_cast<std::size_t>(i)] == wall) {
        fresh.walls.directions.push_back(static_cast<std::uint8_t>(i));
        if (domain_.placement() == WallPlacement::interpolated) fresh.walls.hits.push_back(wall_hit(w, place, i));
      }
  }
}

template <class Real>
WallHit FluidGrid<Real>::wall_hit(const Wall& wall, const Vec3i& place, int i) const {
  const Vec3 from = domain_.centre(place), c(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
  const double share = domain_.wall_share(from, from + domain_.cell_size() * c);
  const Vec3 velocity = wall.surface_velocity(from + share * domain_.cell_size() * c) * velocity_to_lu_;
  return {static_cast<float>(share), static_cast<float>(c.dot(velocity))};
}

template <class Real>
SurfaceFields<Real>& FluidGrid<Real>::require_surface(BlockIndex b) {
  Block<Real>& blk = block(b);
  if (blk.surface) return *blk.surface;
  blk.surface = surface_pool_.acquire();
  has_surface_[static_cast<std::size_t>(b)] = 1;
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
  return s;
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
