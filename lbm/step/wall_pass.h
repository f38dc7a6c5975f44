#pragma once
// The passes over the walls. After a conversion: what is on its way into them comes back, mass that walls moved is
// returned. Before a sweep: walls of the wall model brake. What walls got is booked.
#include <vector>

#include "lbm/boundary/wall_balance.h"
#include "lbm/boundary/wall_load.h"
#include "lbm/boundary/wall_reflection.h"
#include "lbm/step/fluid_level.h"

namespace lahar::lbm {

/// What reflection at walls needs to know of the collision.
WallPhysics wall_physics(const SweepParameters& parameters);

template <class Real>
class WallPass {
 public:
  /// From now on books what the walls get.
  void measure(const Domain& domain) { loads_.assign(domain.walls().all().size(), {}); }
  /// `level` is that of the coming step.
  void reflect(FluidLevel<Real>& level, WallAccount& account);
  /// The same, after the pass over the surface.
  void brake(FluidLevel<Real>& level);
  /// What each wall got since measure(), N s and N m s about the origin of the coordinates; empty if nothing is
  /// measured.
  [[nodiscard]] const std::vector<WallLoad>& loads() const { return loads_; }
  /// State of a checkpoint.
  void transfer(Archive& archive, const Domain& domain);

 private:
  template <class Visit>
  void visit_walls(FluidLevel<Real>& level, const Visit& visit);
  void book(const FluidLevel<Real>& level);

  std::vector<WallLoad> loads_;
  std::vector<BlockWallLoads> block_loads_;  // of the last step, by place in the list of owned blocks
};

extern template class WallPass<float>;
extern template class WallPass<double>;

}  // namespace lahar::lbm
