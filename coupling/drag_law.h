#pragma once
// Drag of a long circular cylinder per length, by the components of the relative velocity.
#include <algorithm>
#include <cmath>
#include <numbers>

namespace lahar::coupling {

/// Normal drag coefficient, force per length = 1/2 rho d Cd u_n^2: Cd = 1 + 10 Re^(-2/3), a fit to experiments for
/// 1 < Re < 2e5 (White 2006, Viscous Fluid Flow, Eq. 3-225). Below Re = 0.1 the value there is kept times 0.1/Re, so
/// that the force stays linear.
inline double normal_drag_coefficient(double reynolds) {
  const double re = std::max(reynolds, 0.1);
  const double cd = 1 + 10 * std::pow(re, -2.0 / 3.0);
  return reynolds < 0.1 ? cd * 0.1 / std::max(reynolds, 1e-12) : cd;
}

/// Tangential coefficient, force per length = 1/2 rho d Ct u_t^2: 2 pi (0.55 Re^(-1/2) + 0.084 Re^(-1/3)) with Re of
/// the normal velocity (Choo & Casarella 1971, J. Hydronautics 5:126).
inline double tangential_drag_coefficient(double reynolds) {
  const double re = std::max(reynolds, 0.1);
  return 2 * std::numbers::pi * (0.55 / std::sqrt(re) + 0.084 / std::cbrt(re));
}

/// Three-point kernel of Roma, Peskin & Berger 1999, J. Comput. Phys. 153:509; r in cells. Sums to 1, and its squares
/// to 1/2, for any offset.
inline double roma_kernel(double r) {
  const double a = std::abs(r);
  if (a <= 0.5) return (1 + std::sqrt(1 - 3 * r * r)) / 3;
  if (a <= 1.5) return (5 - 3 * a - std::sqrt(1 - 3 * (1 - a) * (1 - a))) / 6;
  return 0;
}

inline constexpr double kRomaSquares = 0.5;  ///< sum of squares of the kernel, any offset

/// Undisturbed normal speed from the speed sampled at the wire. The wire's own wake lowers the sampled speed to
/// u_inf (1 - Cd (d/dx) sum(phi^2) / 4): half of the momentum deficit has built up where the wire is. Solved with the
/// law by fixed-point iteration; d/dx is the wire's diameter in cells.
inline double undisturbed_speed(double sampled, double diameter, double kinematic_viscosity, double diameter_cells) {
  double u = sampled;
  for (int k = 0; k < 4; ++k) {
    const double cd = std::min(normal_drag_coefficient(u * diameter / kinematic_viscosity), 10.0);
    u = sampled / std::max(0.4, 1 - cd * diameter_cells * kRomaSquares / 4);
  }
  return u;
}

}  // namespace lahar::coupling
