#pragma once
// The coverage weight for grains of a few cells. When no cell of a packed bed is free of grains, B = eps stops the
// water within one step: the bed is some hundred times less permeable than gravel, and pore suction locks it. The
// weighting of Noble & Torczynski keeps no drag at all as tau -> 1/2. Between them, the form B = eps c / ((1 - eps) +
// c) with c such that the bed lets through what it should (docs/decisions/0003).
#include <cmath>

#include "core/units.h"

namespace lahar::coupling {

inline constexpr double kPackedSolidFraction = 0.64;

/// Superficial velocity (m/s) of water through a bed of spheres under a hydraulic gradient of 1 (Ergun 1952, Chem. Eng.
/// Prog. 48:89): g = 150 nu (1-e)^2 / (e^3 d^2) v + 1.75 (1-e) / (e^3 d) v^2, e the porosity.
inline double ergun_velocity(double diameter, double viscosity, double gravity,
                             double solid_fraction = kPackedSolidFraction) {
  const double e = 1 - solid_fraction, e3 = e * e * e;
  const double a = 1.75 * solid_fraction / (e3 * diameter);
  const double b = 150 * viscosity * solid_fraction * solid_fraction / (e3 * diameter * diameter);
  return (std::sqrt(b * b + 4 * a * gravity) - b) / (2 * a);
}

/// The constant c with which uniform cells of the packed solid fraction, at rest, let through ergun_velocity. In such
/// cells v = (1 - B)(v + a), a the acceleration by gravity in a step, so B = a / (v + a); then c = B (1-eps) / (eps -
/// B).
inline double seepage_constant(double diameter, double viscosity, double gravity, const LatticeUnits& units) {
  const double a = units.acceleration_to_lu(gravity);
  const double v = units.velocity_to_lu(ergun_velocity(diameter, viscosity, gravity));
  const double weight = a / (v + a), eps = kPackedSolidFraction;
  return weight * (1 - eps) / std::max(eps - weight, 1e-6);
}

}  // namespace lahar::coupling
