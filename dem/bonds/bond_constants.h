#pragma once
// What all bonds of a sort share, ready for the loop over bonds.
#include "dem/bonds/axial_law.h"
#include "dem/bonds/bonds.h"

namespace lahar::dem {

struct BondConstants {
  AxialCurve axial;
  double shear_stiffness = 0, bending_stiffness = 0, torsion_stiffness = 0;  ///< N/m, N m/rad, N m/rad
  double tension_limit = 0, bending_to_tension = 0;                          ///< max(F_n, 0) + b |M_b| > limit
  double shear_limit = 0, torsion_to_shear = 0;                              ///< |F_s| + t |M_t| > limit
  double axial_damping = 0, shear_damping = 0;                               ///< times sqrt(effective mass): N s/m
  double bending_damping = 0, torsion_damping = 0;  ///< times sqrt(effective inertia): N m s/rad
  bool plastic = false, damped = false, breakable = false;
};

/// Throws std::logic_error for a sort that makes no sense (see axial_curve).
[[nodiscard]] BondConstants constants_of(const BondSort& sort);

}  // namespace lahar::dem
