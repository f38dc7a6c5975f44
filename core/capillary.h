#pragma once
// How long a time step may be with surface tension.
#include <cmath>
#include <limits>
#include <numbers>

namespace lahar {

/// s: the longest fluid step with surface tension (N/m), sqrt(rho dx^3 / (4 pi sigma)): the shortest ripple, two cells
/// long, runs less than half a cell in it (Brackbill, Kothe & Zemach 1992, J. Comput. Phys. 100, 335, with a gas of no
/// density). Infinite without.
inline double capillary_time_step(double density, double cell_size, double surface_tension) {
  if (surface_tension <= 0) return std::numeric_limits<double>::infinity();
  return std::sqrt(density * cell_size * cell_size * cell_size / (4 * std::numbers::pi * surface_tension));
}

}  // namespace lahar
