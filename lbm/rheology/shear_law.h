#pragma once
// The fluid for what has a shear rate of its own and no cell: wires, averaged grains.
#include <algorithm>
#include <cmath>
#include <limits>

#include "lbm/rheology/rheology.h"

namespace lahar::lbm {

/// Per density, SI.
struct ShearLaw {
  double viscosity = 0;                                    ///< m^2/s^(2-n): K / rho
  double exponent = 1;                                     ///< n
  double yield_stress = 0;                                 ///< m^2/s^2: over rho
  double limit = std::numeric_limits<double>::infinity();  ///< m^2/s: no viscosity is larger

  /// Kinematic viscosity at a shear rate (1/s) without the yield stress, m^2/s.
  [[nodiscard]] double viscosity_at(double rate) const {
    return std::min(limit, exponent == 1 ? viscosity : viscosity * std::pow(std::max(rate, 1e-12), exponent - 1));
  }
  /// Yield stress over the viscous stress.
  [[nodiscard]] double bingham(double rate) const {
    return yield_stress == 0 ? 0.0 : yield_stress / (viscosity_at(rate) * std::max(rate, 1e-12));
  }
};

/// Of a fluid of this kinematic viscosity (m^2/s; Herschel-Bulkley has its own) and density (kg/m^3).
inline ShearLaw shear_law(const RheologyOptions& o, double kinematic_viscosity, double density) {
  switch (o.law) {
    case FlowLaw::newtonian:
      break;
    case FlowLaw::bingham:
      return {kinematic_viscosity, 1, o.yield_stress / density, o.limit_viscosity};
    case FlowLaw::herschel_bulkley:
      return {o.consistency / density, o.exponent, o.yield_stress / density, o.limit_viscosity};
  }
  return {kinematic_viscosity};
}

}  // namespace lahar::lbm
