#pragma once
// Closed forms behind tables of reference/, needed at more places than those hold.
#include <cmath>

namespace lahar::validate {

/// Drag of a random array of spheres of volume fraction phi over 3 pi nu d U, without the buoyancy of the pressure
/// gradient: Beetstra, van der Hoef & Kuipers 2007 (AIChE J. 53:489), eq. 17; +-8 % on its own data
/// (random_array_drag.csv).
inline double drag_of_pack(double phi, double re) {
  const double e = 1 - phi;
  return 10 * phi / (e * e) + e * e * (1 + 1.5 * std::sqrt(phi)) +
         0.413 * re / (24 * e * e) * (1 / e + 3 * phi * e + 8.4 * std::pow(re, -0.343)) /
             (1 + std::pow(10, 3 * phi) * std::pow(re, -(1 + 4 * phi) / 2));
}

/// The same by Ergun 1952 (Chem. Eng. Prog. 48:89), from measurements of packed beds.
inline double drag_of_bed(double phi, double re) {
  const double e = 1 - phi;
  return (150 * phi + 1.75 * re) / (18 * e * e);
}

/// Immersed share x of the diameter of a floating sphere of density ratio s: 3 x^2 - 2 x^3 = s (floating_sphere.csv).
inline double immersed_share(double s) {
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double x = (low + high) / 2;
    (3 * x * x - 2 * x * x * x < s ? low : high) = x;
  }
  return low;
}

}  // namespace lahar::validate
