#include "cases/assembly/memory.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "cases/assembly/geometry.h"
#include "coupling/grains/averaging_grid.h"

namespace lahar::scene {

std::size_t fluid_bytes_per_cell(Precision precision) {
  constexpr std::size_t numbers = 19 + 3 + 7, flags = 6;
  return numbers * (precision == Precision::float32 ? sizeof(float) : sizeof(double)) + flags;
}

double averaging_nodes(const Scene& scene) {
  if (!scene.coupling.enabled || !scene.fluid.enabled || scene.coupling.grains != GrainFluid::averaged) return 0;
  const double dx = scene.fluid.cell_size, length = std::max(scene.coupling.averaging_length, dx);
  double nodes = 1;
  for (const double extent : scene.domain.upper - scene.domain.lower)
    nodes *= coupling::AveragingGrid::divisions(dx * std::ceil(extent / dx - 1e-9), length);
  return nodes;
}

double bytes_of_domain(const Scene& scene) {
  const Vec3 cells = ((scene.domain.upper - scene.domain.lower) / scene.fluid.cell_size).array().ceil();
  return averaging_nodes(scene) * kBytesPerNode + cells.x() * cells.y() * sizeof(int);
}

LiquidOfRegion liquid_of_region(const Scene& scene, const Walls& walls, std::size_t region, double margin) {
  const FluidRegion& r = scene.fluid.regions[region];
  const auto body = make_body(r);
  const auto holds = [](const std::optional<Shape>& shape, const Vec3& p, double reach) {
    return !shape || std::visit([&](const auto& of_kind) { return of_kind.distance(p); }, *shape) < reach;
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
  const bool at_walls = walls.nearest(0.5 * (r.lower + r.upper)).distance < 0.5 * (r.upper - r.lower).norm();
  const double height = r.upper.z() - r.lower.z();
  if (!body && before.empty() && !at_walls) return {1, height};
  constexpr int n = 24, nz = 256;  // points along an edge; more upwards, for thin layers on high ground
  int inside = 0, deepest = 0;
  for (int column = 0; column < n * n; ++column) {
    int deep = 0;
    for (int k = 0; k < nz; ++k) {
      const Vec3 part((column % n + 0.5) / n, (column / n + 0.5) / n, (k + 0.5) / nz);
      const Vec3 p = r.lower + part.cwiseProduct(r.upper - r.lower);
      if (holds(body, p, margin) && !(at_walls && walls.nearest(p).distance < -margin) && !is_counted(p)) ++deep;
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
