#include "lbm/step/wall_pass.h"

#include <algorithm>
#include <string>

#include "core/parallel.h"
#include "lbm/boundary/wall_braking.h"

namespace lahar::lbm {

namespace {

constexpr std::size_t kBlocksPerTask = 8;  // a group of the population layout

}  // namespace

WallPhysics wall_physics(const SweepParameters& p) {
  return {(p.tau - 0.5) / 3, p.gravity, p.rheology.law == FlowLaw::newtonian, equilibrium_order(p.collision)};
}

/// Calls visit(block, what the walls get there, or null) for all blocks with walls, then books that.
template <class Real>
template <class Visit>
void WallPass<Real>::visit_walls(FluidLevel<Real>& level, const Visit& visit) {
  const auto& owned = level.grid.owned();
  const bool measured = !loads_.empty();
  if (measured) block_loads_.resize(std::max(block_loads_.size(), owned.size()));
  parallel_for(0, owned.size(), kBlocksPerTask, [&](std::size_t k) {
    if (measured) block_loads_[k].clear();
    if (level.grid.has_walls(owned[k])) visit(owned[k], measured ? &block_loads_[k] : nullptr);
  });
  if (measured) book(level);
}

template <class Real>
void WallPass<Real>::reflect(FluidLevel<Real>& level, WallAccount& account) {
  const WallPhysics physics = wall_physics(level.parameters);
  visit_walls(level, [&](BlockIndex b, BlockWallLoads* loads) {
    reflect_at_walls(level.grid, b, level.parity(), physics, loads);
  });
  if (some_wall_moves_mass(level.grid.domain())) balance_walls(level.grid, account);
}

template <class Real>
void WallPass<Real>::brake(FluidLevel<Real>& level) {
  const auto& walls = level.grid.domain().walls().all();
  if (std::none_of(walls.begin(), walls.end(), [](const Wall& w) { return w.slip == WallSlip::wall_model; })) return;
  const WallPhysics physics = wall_physics(level.parameters);
  visit_walls(level, [&](BlockIndex b, BlockWallLoads* loads) {
    brake_at_walls(level.grid, b, level.parity(), physics, loads);
  });
}

/// Adds the loads of a pass in the order of the blocks, so that the sum does not depend on the threads.
template <class Real>
void WallPass<Real>::book(const FluidLevel<Real>& level) {
  const LatticeUnits& units = level.units;
  const double impulse = units.mass() * units.velocity_to_si(1.0);
  for (std::size_t k = 0; k < level.grid.owned().size(); ++k)
    for (const auto& [wall, load] : block_loads_[k].entries()) {
      WallLoad& sum = loads_[static_cast<std::size_t>(wall)];
      sum.impulse += impulse * load.impulse;
      sum.angular_impulse +=
          impulse * (units.cell_size * load.angular_impulse + level.grid.domain().origin().cross(load.impulse));
    }
}

template <class Real>
void WallPass<Real>::transfer(Archive& archive, const Domain& domain) {
  std::size_t measured = loads_.size();
  archive.value("measured_walls", measured);
  loads_.resize(std::min(measured, domain.walls().all().size()));
  for (std::size_t k = 0; k < loads_.size(); ++k) archive.part("wall_load_" + std::to_string(k), loads_[k]);
}

template class WallPass<float>;
template class WallPass<double>;

}  // namespace lahar::lbm
