#pragma once
// What the yield stress of mud adds to the drag on a lone sphere and on a long cylinder in creeping flow, fitted to the
// fields that make the dissipation least (cases/validate/grains_in_fluid/drag_in_mud_reference.py), within 1 % for Bn =
// yield d / (mu u) from 0.1 (spheres: 1) to 100:
//   sphere    F = 3 pi mu d u [1 + Bn (1.166 + 1.83 Bn^-0.535)]
//   cylinder  F per length = F(yield = 0) + yield d (11.94 + 15.6 Bn^-0.575), with F(yield = 0) near 2 mu u
// As Bn -> infinity these are those of a plastic body, 2 pi R^2 yield / 0.143 (Beris et al. 1985, J. Fluid Mech.
// 158:219) and yield d (2 pi + 4 sqrt 2) (Randolph & Houlsby 1984, Geotechnique 34:613); as Bn -> 0 a sphere's
// correction goes with about Bn^(1/2), as it must (Taylor-West & Hogg 2025, J. Fluid Mech.).
#include <algorithm>
#include <cmath>

#include "lbm/rheology/shear_law.h"

namespace lahar::coupling {

/// Drag over that of the same fluid without a yield stress.
inline double sphere_yield_factor(double bingham) {
  return bingham <= 0 ? 1.0 : 1 + 1.166 * bingham + 1.83 * std::pow(bingham, 1 - 0.535);
}

/// Kinematic viscosity, m^2/s, of the Newtonian fluid that drags as much on a slow sphere.
inline double viscosity_past_sphere(const lbm::ShearLaw& fluid, double diameter, double speed) {
  const double rate = speed / diameter, viscosity = fluid.viscosity_at(rate);
  return fluid.yield_stress == 0 ? viscosity
                                 : std::min(fluid.limit, viscosity * sphere_yield_factor(fluid.bingham(rate)));
}

/// What is added to the drag per length, over yield stress and diameter; bingham > 0.
inline double cylinder_yield_coefficient(double bingham) { return 11.94 + 15.6 * std::pow(bingham, -0.575); }

}  // namespace lahar::coupling
