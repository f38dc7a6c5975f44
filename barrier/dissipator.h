#pragma once
// Bond sorts of wires and of dissipators (Li, Zhao & Kwan 2020, Eq. 1, Fig. 3 and Table 4). Stiffness is per unit area
// of the bond's cross-section, N/m^3, and the same in shear.
#include <limits>

#include "dem/bonds/bonds.h"

namespace lahar::barrier {

/// A linear elastic wire.
[[nodiscard]] inline dem::BondSort wire_bond(double stiffness, double bond_radius) {
  dem::BondSort sort;
  sort.axial.stiffness = {stiffness, stiffness, stiffness};
  sort.shear_stiffness = stiffness;
  sort.bond_radius = bond_radius;
  return sort;
}

/// Three stages: `first` below the activation force, `second` up to the stiffening force, then `third`.
[[nodiscard]] inline dem::BondSort dissipator_bond(double first, double second, double third, double activation_force,
                                                   double stiffening_force, double bond_radius) {
  dem::BondSort sort = wire_bond(first, bond_radius);
  sort.axial.stiffness = {first, second, third};
  sort.axial.force_limit = {activation_force, stiffening_force};
  return sort;
}

/// Two stages: it never stiffens again.
[[nodiscard]] inline dem::BondSort dissipator_bond(double first, double second, double activation_force,
                                                   double bond_radius) {
  return dissipator_bond(first, second, second, activation_force, std::numeric_limits<double>::infinity(), bond_radius);
}

}  // namespace lahar::barrier
