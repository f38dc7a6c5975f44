#include "cases/assembly/memory.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "cases/assembly/geometry.h"
#include "cases/assembly/grain_extent.h"
#include "cases/assembly/grain_sizes.h"
#include "coupling/grains/averaging_grid.h"
#include "lbm/free_surface/block_changes.h"
#include "lbm/grid/domain.h"
#include "lbm/grid/pool.h"

namespace lahar::scene {

namespace {

/// Bytes of an object in a pool, whose pages hold whole ones (lbm/grid/pool.h).
template <class T>
double pooled_bytes() {
  constexpr std::size_t page = lbm::LargePages<T>::page, per_page = page / sizeof(T);
  return static_cast<double>(page) / per_page;
}

/// Bytes of the populations of a block, whose slabs fill whole pages.
template <class Real>
double population_bytes() {
  using Pool = lbm::PopulationPool<Real>;
  constexpr std::size_t page = lbm::LargePages<Real>::page;
  constexpr std::size_t pages = (Pool::groups_per_slab * Pool::group_size * sizeof(Real) + page - 1) / page;
  return static_cast<double>(pages * page) / (Pool::groups_per_slab * Pool::blocks_per_group);
}

/// Bytes of the links of a layer of cells along a wall (WallLinks), five of each cell.
double wall_bytes(WallPlacement placement) {
  constexpr double cells = lbm::kBlockWidth * lbm::kBlockWidth, links = 5, direction = sizeof(std::uint8_t),
                   gain = sizeof(double);
  const double hit = placement == WallPlacement::interpolated ? sizeof(lbm::WallHit) : 0;
  return cells * (sizeof(lbm::WallCell) + gain + links * (direction + hit)) +
         lbm::kBlockWidth * links * sizeof(lbm::RowLink);
}

struct BlockBytes {
  double fluid, bodies;
};

template <class Real>
BlockBytes block_bytes(const Scene& scene) {
  // Blocks know those around them by index (block_topology.h) and by address (fluid_grid.h).
  constexpr double places = 27 * (sizeof(lbm::BlockIndex) + sizeof(void*)) + sizeof(Vec3i) + sizeof(std::uint64_t);
  const bool impulses =
      scene.coupling.grains == GrainFluid::averaged || (scene.barrier.enabled && scene.coupling.wire_drag);
  return {population_bytes<Real>() + pooled_bytes<lbm::Block<Real>>() + pooled_bytes<lbm::SurfaceFields<Real>>() +
              wall_bytes(scene.fluid.wall_placement) + sizeof(lbm::BlockChanges<Real>) + places,
          pooled_bytes<lbm::BodyFields<Real>>() + (impulses ? pooled_bytes<lbm::ImpulseFields<Real>>() : 0)};
}

BlockBytes block_bytes(const Scene& scene) {
  return scene.run.precision == Precision::float32 ? block_bytes<float>(scene) : block_bytes<double>(scene);
}

/// Blocks that something of this extent (m) reaches, on the mean over its places.
double blocks_over(const Vec3& extent, double cell_size) {
  return (extent / (lbm::kBlockWidth * cell_size) + Vec3::Ones()).prod();
}

/// m, from the surface of a body to the farthest cell that gets something of it.
double reach_of_grains(const Scene& scene) {
  const bool averaged = scene.coupling.grains == GrainFluid::averaged;
  return scene.fluid.cell_size + (averaged ? scene.coupling.averaging_length : 0);
}

double blocks_with_grains(const Scene& scene, double spreading) {
  const double dx = scene.fluid.cell_size, reach = reach_of_grains(scene);
  const auto around = [&](double diameter) { return blocks_over(Vec3::Constant(diameter + 2 * reach), dx); };
  double blocks = 0;
  for (const GrainSphere& s : scene.grains.spheres) blocks += around(s.diameter);
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i) {
    const Packing& packing = scene.grains.packings[i];
    double one_by_one = 0;
    for (const GrainSize& s : grain_sizes(scene, i)) one_by_one += static_cast<double>(s.count) * around(s.diameter);
    const Vec3 extent = upper_of_content(packing) - packing.lower + Vec3::Constant(2 * reach);
    blocks += std::min(one_by_one, spreading * blocks_over(extent, dx));
  }
  return blocks;
}

double blocks_with_wires(const Scene& scene) {
  if (!scene.barrier.enabled || !(scene.coupling.wire_drag || scene.coupling.resolve_wires_from_cells)) return 0;
  const Net& net = scene.barrier.net;
  const double spans = scene.barrier.posts.enabled ? static_cast<double>(scene.barrier.posts.spans) : 1.0;
  const double dx = scene.fluid.cell_size, reach = 2 * dx;
  return spans * blocks_over(Vec3(net.width, net.height, net.wire_diameter) + Vec3::Constant(2 * reach), dx);
}

}  // namespace

double bytes_of_blocks(const Scene& scene, double blocks, double with_bodies) {
  const BlockBytes bytes = block_bytes(scene);
  return blocks * bytes.fluid + with_bodies * bytes.bodies;
}

double blocks_with_bodies(const Scene& scene, double blocks, double spreading) {
  if (!scene.coupling.enabled) return 0;
  return std::min(blocks, blocks_with_grains(scene, spreading) + blocks_with_wires(scene));
}

double averaging_nodes(const Scene& scene) {
  if (!scene.coupling.enabled || !scene.fluid.enabled || scene.coupling.grains != GrainFluid::averaged) return 0;
  const double dx = scene.fluid.cell_size, length = std::max(scene.coupling.averaging_length, dx);
  double nodes = 1;
  for (const double extent : scene.domain.upper - scene.domain.lower)
    nodes *= coupling::AveragingGrid::divisions(dx * lbm::covering_cells(extent, dx), length);
  return nodes;
}

double bytes_of_domain(const Scene& scene) {
  const Vec3 extent = scene.domain.upper - scene.domain.lower;
  const auto cells = [&](double e) { return lbm::covering_cells(e, scene.fluid.cell_size); };
  return averaging_nodes(scene) * kBytesPerNode + cells(extent.x()) * cells(extent.y()) * sizeof(int);
}

double bytes_at_start(const Scene& scene, double blocks, double cells) {
  const double fields_of_bodies = bytes_of_blocks(scene, 0, blocks_with_bodies(scene, blocks, 1));
  return bytes_of_blocks(scene, blocks, 0) + std::max(kBytesPerFilledCell * cells, fields_of_bodies) +
         bytes_of_domain(scene);
}

double bytes_when_spread(const Scene& scene, double blocks, double spreading) {
  return bytes_of_blocks(scene, blocks, blocks_with_bodies(scene, blocks, spreading)) + bytes_of_domain(scene);
}

namespace {

double distance_to(const Shape& shape, const Vec3& p) {
  return std::visit([&](const auto& of_kind) { return of_kind.distance(p); }, shape);
}

/// The walls that may reach into a box: no other has a point of it inside.
std::vector<const Shape*> walls_in_reach(const Walls& walls, const Vec3& lower, const Vec3& upper) {
  const Vec3 centre = 0.5 * (lower + upper);
  const double to_corner = 0.5 * (upper - lower).norm();
  const auto may_reach = [&](const Shape& shape) {
    if (const auto* box = std::get_if<SolidBox>(&shape))
      return (box->lower.array() < upper.array()).all() && (box->upper.array() > lower.array()).all();
    if (const auto* plane = std::get_if<HalfSpace>(&shape))
      return plane->distance(centre) < 0.5 * plane->normal.cwiseAbs().dot(upper - lower);
    // An exact distance changes by no more than the way, one that is interpolated in a grid by sqrt(3) of it.
    const double slope = std::holds_alternative<SampledDistance>(shape) ? std::sqrt(3.0) : 1.0;
    return distance_to(shape, centre) < slope * to_corner;
  };
  std::vector<const Shape*> near;
  for (const Wall& wall : walls.all())
    if (!wall.open && may_reach(wall.shape)) near.push_back(&wall.shape);
  return near;
}

}  // namespace

LiquidOfRegion liquid_of_region(const Scene& scene, const Walls& walls, std::size_t region, double margin) {
  const FluidRegion& r = scene.fluid.regions[region];
  const auto body = make_body(r);
  const auto holds = [](const std::optional<Shape>& shape, const Vec3& p, double reach) {
    return !shape || distance_to(*shape, p) < reach;
  };
  struct Before {
    const FluidRegion* region;
    std::optional<Shape> body;
  };
  std::vector<Before> before;
  for (std::size_t k = 0; k < region; ++k) {
    const FluidRegion& b = scene.fluid.regions[k];
    if ((b.lower.array() < r.upper.array()).all() && (r.lower.array() < b.upper.array()).all())
      before.push_back({&b, make_body(b)});
  }
  const auto is_counted = [&](const Vec3& p) {
    return std::any_of(before.begin(), before.end(), [&](const Before& b) {
      return (p.array() >= b.region->lower.array()).all() && (p.array() <= b.region->upper.array()).all() &&
             holds(b.body, p, 0);
    });
  };
  const std::vector<const Shape*> near = walls_in_reach(walls, r.lower, r.upper);
  const auto is_in_wall = [&](const Vec3& p) {
    return std::ranges::any_of(near, [&](const Shape* wall) { return distance_to(*wall, p) < -margin; });
  };
  const double height = r.upper.z() - r.lower.z();
  if (!body && before.empty() && near.empty()) return {1, height};
  constexpr int n = 24, nz = 256;  // points along an edge; more upwards, for thin layers on high ground
  int inside = 0, deepest = 0;
  for (int column = 0; column < n * n; ++column) {
    int deep = 0;
    for (int k = 0; k < nz; ++k) {
      const Vec3 part((column % n + 0.5) / n, (column / n + 0.5) / n, (k + 0.5) / nz);
      const Vec3 p = r.lower + part.cwiseProduct(r.upper - r.lower);
      if (holds(body, p, margin) && !is_in_wall(p) && !is_counted(p)) ++deep;
    }
    inside += deep, deepest = std::max(deepest, deep);
  }
  return {static_cast<double>(inside) / (n * n * nz), height * deepest / nz};
}

double liquid_cells(const Scene& scene) {
  const Walls walls = make_walls(scene);
  double volume = 0;
  for (std::size_t k = 0; k < scene.fluid.regions.size(); ++k) {
    const FluidRegion& r = scene.fluid.regions[k];
    volume += (r.upper - r.lower).prod() * liquid_of_region(scene, walls, k).share;
  }
  return volume / std::pow(scene.fluid.cell_size, 3);
}

double inflow_cells(const Scene& scene, double time) {
  double volume = 0;
  for (const Inflow& i : scene.fluid.inflows) {
    const lbm::Hydrograph h = hydrograph_of(i);
    volume += h.volume_until(time) - h.volume_until(0);
  }
  return volume / std::pow(scene.fluid.cell_size, 3);
}

std::size_t physical_memory() {
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace lahar::scene
