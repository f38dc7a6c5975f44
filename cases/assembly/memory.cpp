#include "cases/assembly/memory.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "cases/assembly/geometry.h"
#include "coupling/grains/averaging_grid.h"

namespace lahar::scene {

namespace {

/// What a region has of the box around it, judged at the points of a lattice.
double share_of_box(const FluidRegion& region) {
  const auto body = make_body(region);
  if (!body) return 1;
  constexpr int n = 24;  // points along an edge
  int inside = 0;
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 part((i % n + 0.5) / n, (i / n % n + 0.5) / n, (i / (n * n) + 0.5) / n);
    const Vec3 p = region.lower + part.cwiseProduct(region.upper - region.lower);
    if (std::visit([&](const auto& shape) { return shape.distance(p); }, *body) < 0) ++inside;
  }
  return static_cast<double>(inside) / (n * n * n);
}

}  // namespace

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

double liquid_cells(const Scene& scene) {
  double volume = 0;
  for (const FluidRegion& r : scene.fluid.regions) volume += (r.upper - r.lower).prod() * share_of_box(r);
  return volume / std::pow(scene.fluid.cell_size, 3);
}

double inflow_cells(const Scene& scene, double time) {
  double volume = 0;
  for (const Inflow& i : scene.fluid.inflows) volume += hydrograph_of(i).volume_until(time);
  return volume / std::pow(scene.fluid.cell_size, 3);
}

std::size_t physical_memory() {
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace lahar::scene
