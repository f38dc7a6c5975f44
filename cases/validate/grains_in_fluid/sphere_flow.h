#pragma once
// What the entries of resolved spheres share: spheres held fixed in a fluid without a surface, in lattice units (cell
// size, time step and density 1), and the momentum audit.
#include <vector>

#include "cases/validate/entry.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {

/// How bodies act on the fluid. The defaults are those of docs/decisions/0020.
struct Immersion {
  lbm::CollisionOperator collision = lbm::Trt{};
  lbm::BodyWeighting weighting = lbm::kBodyWeighting;
  lbm::SolidOperator solid_operator = lbm::kSolidOperator;
  double radius_shift =
      coupling::kRadiusShift;  ///< cells; fitted on the array of volume fraction 0.216 at 6 cells a diameter
  double smagorinsky = 0;
  lbm::RheologyOptions rheology = {};
};

/// Row of an audit: what the bodies got against what the fluid gave, 1e-10 in double precision.
Row audit_row(const std::string& label, const coupling::MomentumAudit& audit);

/// A slab of cells [first, last) along x in which the fluid is pulled towards a velocity along x: an inlet in a
/// periodic box.
struct Fringe {
  int first = 0, last = 0;
  double speed = 0;  ///< lu
  double drag = 0;   ///< in the units of the weighting
};

template <class Real>
class SphereFlow {
 public:
  /// Fixed spheres in a periodic box; `flow` gives the velocity outside of them at the start, lu.
  SphereFlow(const Vec3i& cells, double viscosity, const Vec3& gravity, const Immersion& immersion,
             const std::vector<Vec3>& centres, double radius, const Vec3& flow);
  void set_fringe(const Fringe& fringe);

  void step();
  /// The spheres move from now on, all alike, lu.
  void move_spheres(const Vec3& velocity);
  /// Force of the fluid on all spheres in the last step, with their buoyancy, lu.
  [[nodiscard]] Vec3 force();
  /// Velocity between collisions over all cells: the superficial one once the flow is steady.
  [[nodiscard]] Vec3 mean_velocity();
  /// Without a fringe, whose momentum it does not know of.
  [[nodiscard]] const coupling::MomentumAudit& audit() const { return step_.audit(); }

 private:
  coupling::CoupledStep<Real> step_;
};

extern template class SphereFlow<float>;
extern template class SphereFlow<double>;

}  // namespace lahar::validate
