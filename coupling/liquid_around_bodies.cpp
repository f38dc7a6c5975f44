#include "coupling/liquid_around_bodies.h"

#include <algorithm>
#include <optional>
#include <variant>

#include "core/parallel.h"
#include "lbm/free_surface/covered_cells.h"

namespace lahar::coupling {

namespace {

using lbm::LiquidRegion;

struct Ball {
  Vec3 centre;
  double radius;
};

/// The grains that reach into a box.
std::vector<Ball> grains_in(const dem::Particles& p, const Vec3& lower, const Vec3& upper) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.kind[i] != dem::ParticleKind::grain || p.state[i] == dem::ParticleState::removed) continue;
    const Vec3 x = p.position[i];
    if ((x - x.cwiseMax(lower).cwiseMin(upper)).squaredNorm() < p.radius[i] * p.radius[i])
      balls.push_back({x, p.radius[i]});
  }
  return balls;
}

bool holds(const LiquidRegion& region, const Vec3& point) {
  if ((point.array() < region.lower.array()).any() || (point.array() > region.upper.array()).any()) return false;
  return !region.body || std::visit([&](const auto& shape) { return shape.distance(point) < 0; }, *region.body);
}

/// Of what grains fill of a cell, the part that lies in no region; nothing where no point of the cell lies in a grain.
std::optional<double> part_out_of_liquid(const Vec3& centre, double dx, const std::vector<Ball>& balls,
                                         const std::vector<LiquidRegion>& regions) {
  constexpr int points = 8;  // along an edge
  int solid = 0, out = 0;
  for (int n = 0; n < points * points * points; ++n) {
    const Vec3i k(n % points, n / points % points, n / (points * points));
    const Vec3 point = centre + dx * ((k.cast<double>() + Vec3::Constant(0.5)) / points - Vec3::Constant(0.5));
    if (std::none_of(balls.begin(), balls.end(),
                     [&](const Ball& b) { return (point - b.centre).squaredNorm() < b.radius * b.radius; }))
      continue;
    ++solid;
    out += std::none_of(regions.begin(), regions.end(), [&](const LiquidRegion& r) { return holds(r, point); });
  }
  if (solid == 0) return std::nullopt;
  return static_cast<double>(out) / solid;
}

}  // namespace

template <class Real>
void add_bodies_out_of_liquid(lbm::FluidGrid<Real>& grid, const dem::Particles& particles,
                              const std::vector<LiquidRegion>& regions) {
  const double dx = grid.domain().cell_size();
  const std::vector<lbm::BlockIndex>& blocks = grid.owned();
  parallel_for(0, blocks.size(), 4, [&](std::size_t k) {
    lbm::Block<Real>& block = grid.block(blocks[k]);
    if (!block.surface || !block.body) return;
    lbm::SurfaceFields<Real>& surface = *block.surface;
    const Vec3 half = Vec3::Constant(dx / 2);
    const std::vector<Ball> balls =
        grains_in(particles, grid.centre(blocks[k], 0) - half, grid.centre(blocks[k], lbm::kBlockCells - 1) + half);
    for (int n = 0; n < lbm::kBlockCells; ++n) {
      const Real solid = std::min(Real(1), block.body->solid_fraction[n]);
      if (block.type[static_cast<std::size_t>(n)] != lbm::CellType::interface || lbm::is_covered(block, n) ||
          solid <= 0)
        continue;
      const Real whole = Real(1) + surface.density[n], missing = std::max(Real(0), whole - surface.mass[n]);
      const std::optional<double> out = part_out_of_liquid(grid.centre(blocks[k], n), dx, balls, regions);
      surface.mass[n] += out ? std::min(missing, solid * static_cast<Real>(*out)) : solid * missing;
      surface.fill_level[n] = std::clamp(surface.mass[n] / whole, Real(0), Real(1));
    }
  });
}

template void add_bodies_out_of_liquid<float>(lbm::FluidGrid<float>&, const dem::Particles&,
                                              const std::vector<LiquidRegion>&);
template void add_bodies_out_of_liquid<double>(lbm::FluidGrid<double>&, const dem::Particles&,
                                               const std::vector<LiquidRegion>&);

}  // namespace lahar::coupling
