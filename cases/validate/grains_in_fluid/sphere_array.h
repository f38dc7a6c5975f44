#pragma once
// Drag of a simple-cubic array of spheres on some grid.
#include "cases/validate/grains_in_fluid/sphere_flow.h"

namespace lahar::validate {

struct SphereArray {
  int cells = 8;        ///< of the periodic cube
  int per_side = 1;     ///< spheres along an edge of the cube
  double fraction = 0;  ///< volume fraction
  double drag = 1;      ///< K of the reference
  Vec3 offset;          ///< centre of the first sphere
};

struct ArrayResult {
  double drag = 0, diameter = 0;  ///< K; cells
  coupling::MomentumAudit audit;
};

/// K at tau - 1/2 = shifted_viscosity.
ArrayResult array_drag(const SphereArray& array, double shifted_viscosity, const Immersion& immersion);

}  // namespace lahar::validate
