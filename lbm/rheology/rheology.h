#pragma once
// Flow laws of mud and slurry, as a user states them (SI) and as the sweep takes them (lattice units).
//
// Shear stress of a yield-stress fluid at the shear rate g = sqrt(2 D_ab D_ab) (Herschel & Bulkley 1926; Bingham for n
// = 1):
//   stress = yield + K g^n,   effective kinematic viscosity nu(g) = min(nu_limit, (yield / g + K g^(n-1)) / rho).
// Below the yield stress the fluid creeps with the limit viscosity instead of standing still: the bi-viscous model
// (Beverly & Tanner 1992), sharp at the yield point where an exponential regularization would round it off.
#include <cmath>

#include "core/units.h"

namespace lahar::lbm {

enum class FlowLaw { newtonian, bingham, herschel_bulkley };

/// SI. Bingham: the plastic viscosity is the fluid's kinematic viscosity. Herschel-Bulkley: consistency and exponent.
struct RheologyOptions {
  FlowLaw law = FlowLaw::newtonian;
  double yield_stress = 0;     ///< Pa
  double consistency = 0;      ///< K, Pa s^n; Herschel-Bulkley alone
  double exponent = 1;         ///< n; Herschel-Bulkley alone
  double limit_viscosity = 0;  ///< m^2/s, the largest viscosity: that of the fluid below its yield stress
  bool operator==(const RheologyOptions&) const = default;
};

/// The same per mass in lattice units; Bingham has its plastic viscosity as consistency and exponent 1.
struct RheologyParameters {
  FlowLaw law = FlowLaw::newtonian;
  double yield = 0, consistency = 0, exponent = 1;
  double limit_tau = 1;  ///< relaxation time at the limit viscosity
};

inline RheologyParameters rheology_to_lu(const RheologyOptions& o, double kinematic_viscosity,
                                         const LatticeUnits& units) {
  const double dt = units.time_step, dx = units.cell_size;
  RheologyParameters p;
  p.law = o.law;
  p.yield = o.yield_stress / units.density * dt * dt / (dx * dx);
  p.exponent = o.law == FlowLaw::herschel_bulkley ? o.exponent : 1;
  const double consistency = o.law == FlowLaw::herschel_bulkley ? o.consistency / units.density : kinematic_viscosity;
  p.consistency = consistency * std::pow(dt, 2 - p.exponent) / (dx * dx);
  p.limit_tau = 0.5 + 3 * units.viscosity_to_lu(o.limit_viscosity);
  return p;
}

/// tau times the shear rate, the local measure of stress that a cell knows (see bingham.h), at a shear rate; lattice
/// units.
inline double loading(const RheologyParameters& p, double shear_rate) {
  return 0.5 * shear_rate + 3 * (p.yield + p.consistency * std::pow(shear_rate, p.exponent));
}

}  // namespace lahar::lbm
