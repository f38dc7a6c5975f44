#pragma once
// A sphere that settles from rest in a closed box of oil (ten Cate et al. 2002). The fluid feels no gravity and the
// sphere its weight less the buoyancy: the same flow without the pressure of the depth, which would compress a lattice
// fluid by several percent at these time steps.
#include <string>
#include <vector>

#include "cases/validate/grains_in_fluid/sphere_flow.h"

namespace lahar::validate {

/// Of tencate2002.csv; sphere, box and start are those of its first lines.
struct Oil {
  std::string name;
  double density, viscosity;  ///< kg/m^3, Pa s
  double fastest;             ///< m/s: the highest speed that was measured
  double lattice_speed;       ///< of the fastest, for tau - 1/2 below 0.5
};

/// E1 to E4.
std::vector<Oil> oils();

struct Fall {
  double fastest = 0, shifted_viscosity = 0;
  coupling::MomentumAudit audit;
  std::vector<double> time, speed;  ///< s, m/s
};

/// How the fall is computed.
struct FallGrid {
  int cells_per_diameter = 12, substeps = 1;
  Immersion immersion = {};
};

/// Until the sphere has begun to slow down, or down to the floor.
template <class Real>
Fall fall_in(const Oil& oil, const FallGrid& grid, bool to_floor);

}  // namespace lahar::validate
