#pragma once
// Links: bonds that pull and push along their line and do nothing else, like a shackle or a strut with a joint at
// either end.
#include <numbers>

#include "dem/bonds/bonds.h"

namespace lahar::barrier {

/// A bond sort of this axial stiffness (N/m), without shear. Bending and torsion of a bond grow with the fourth power
/// of its radius, so a section of 1e-4 of the bead (`bead_radius`, m) leaves them 1e-8 of what a wire has.
[[nodiscard]] inline dem::BondSort link_bond(double stiffness, double bead_radius) {
  dem::BondSort sort;
  sort.bond_radius = 1e-4 * bead_radius;
  const double per_area = stiffness / (std::numbers::pi * sort.bond_radius * sort.bond_radius);
  sort.axial.stiffness = {per_area, per_area, per_area};
  return sort;
}

}  // namespace lahar::barrier
