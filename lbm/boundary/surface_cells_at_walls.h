#pragma once
// Interface cells at no-slip walls where viscosity is small.
//
// Bounce-back turns 2/36 of a cell's mass round along the wall and takes a third of its momentum in a step: a stress of
// u/3, where viscosity has nu u / y. Inside the liquid what a step takes the next one gives back, because the stress
// that it leaves turns round in the collision. An interface cell forgets: it is refilled in equilibrium, or relaxes
// with a bounded rate (collision/stress_limit.h). The toe of a fast flow is made of such cells, and stood nearly still.
// Their walls therefore move so that their links exert the stress of the law below (wall_traction.h).
//   Gas on the far side: a film of the cell's fill level F. Its profile is Nusselt's (1916), a mean of u means a stress
//   of 3 nu u / F. The populations are those of a full cell, whose momentum changes F times less than the film's: over
//   the cell 3 nu u / F^2.
//   Otherwise nu u / (1/2).
// Neither is more than bounce-back's u/3: films with F below sqrt(9 nu) run faster than theory (docs/decisions/0044).
#include "lbm/boundary/wall_traction.h"

namespace lahar::lbm {

/// Velocity of a no-slip wall at an interface cell, as the reflection sees it. Liquid at rest sends what weighs on it
/// with half a step's force, which is no velocity: the wall stands still then.
template <class Real>
std::array<Real, 3> surface_cell_wall_velocity(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall,
                                               Parity parity, const WallPhysics& physics, const CellMoments<Real>& m) {
  const Vec3 n(wall.normal[0], wall.normal[1], wall.normal[2]);
  const Vec3 half_force = 0.5 * Vec3(physics.acceleration[0], physics.acceleration[1], physics.acceleration[2]);
  const Vec3 slip = slip_of(wall, m) - (half_force - half_force.dot(n) * n);
  const double speed = slip.norm();
  if (speed < 1e-12) return own_velocity<Real>(wall);
  const CellType beyond = grid.type(grid.neighbour(place, direction_away(n)));
  double share = 2 * physics.viscosity;
  if (!is_wet(beyond) && beyond != CellType::wall) {
    const double fill = static_cast<double>(grid.block(place.block).surface->fill_level[place.cell]);
    share = 3 * physics.viscosity / std::max(fill * fill, 1e-6);
  }
  return braking_velocity(grid, place, wall, parity, m, Vec3(slip / speed), speed,
                          std::min(share, kLargestStressShare) * speed);
}

}  // namespace lahar::lbm
