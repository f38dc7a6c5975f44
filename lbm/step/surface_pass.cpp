#include "lbm/step/surface_pass.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "lbm/boundary/slip_wall.h"
#include "lbm/free_surface/face_sums.h"
#include "lbm/free_surface/surface_exchange.h"
#include "lbm/free_surface/surface_shear.h"

namespace lahar::lbm {

namespace {

constexpr std::size_t kBlocksPerTask = 8;        // a group of the population layout
constexpr double kLargestGradient = 2;           // of pressure at the surface, in rho g
constexpr double kCapillaryGradient = 1.0 / 16;  // the same by surface tension: sigma / R^2 at a radius of 4 cells

}  // namespace

template <class Real>
void SurfacePass<Real>::run(FluidLevel<Real>& level, double surface_tension) {
  const auto& g = level.parameters.gravity;
  const double tension = level.units.surface_tension_to_lu(surface_tension);
  const double largest = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) + kCapillaryGradient * tension;
  const SurfacePhysics<Real> physics{
      .equilibrium_order = equilibrium_order(level.parameters.collision),
      .largest_gradient = static_cast<Real>(kLargestGradient * largest),
      .surface_tension = static_cast<Real>(tension),
      .gravity = {static_cast<Real>(g[0]), static_cast<Real>(g[1]), static_cast<Real>(g[2])},
      .weight = static_cast<Real>(largest)};
  FluidGrid<Real>& grid = level.grid;
  const auto& owned = grid.owned();
  const bool viscous = largest > 0 && feels_surface_shear(level.parameters);
  if (viscous) measure_shears(level);
  parallel_for(0, owned.size(), kBlocksPerTask, [&](std::size_t k) {
    if (grid.has_surface(owned[k])) sum_over_faces(grid, owned[k], level.parity());
  });
  parallel_for(0, owned.size(), kBlocksPerTask, [&](std::size_t k) {
    if (!grid.has_surface(owned[k])) {
      if (grid.block(owned[k]).body) grid.block(owned[k]).body->lacks = false;
      return;
    }
    exchange_over_mirrors(grid, owned[k], level.parity());
    exchange_surface(grid, owned[k], level.parity(), physics, viscous ? shear_[k].data() : nullptr);
  });
}

template <class Real>
void SurfacePass<Real>::measure_shears(FluidLevel<Real>& level) {
  const auto& owned = level.grid.owned();
  shear_.resize(std::max(shear_.size(), owned.size()));
  parallel_for(0, owned.size(), kBlocksPerTask, [&](std::size_t k) {
    if (level.grid.has_surface(owned[k])) measure_shear(level.grid, owned[k], level.parameters, shear_[k]);
  });
}

template class SurfacePass<float>;
template class SurfacePass<double>;

}  // namespace lahar::lbm
