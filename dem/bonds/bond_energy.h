#pragma once
// Energy of bonds: what they hold now and what they have lost.
#include <cstddef>

#include "dem/bonds/bond_constants.h"
#include "dem/bonds/bonds.h"

namespace lahar::dem {

/// Energy in J. The first four are stored, the rest is lost.
struct BondEnergy {
  double axial = 0, shear = 0, bending = 0, torsion = 0;
  double damping = 0;   ///< dissipated by bond damping
  double plastic = 0;   ///< dissipated by plastic elongation
  double breakage = 0;  ///< held by bonds at the moment they broke

  [[nodiscard]] double elastic() const { return axial + shear + bending + torsion; }
  [[nodiscard]] double dissipated() const { return damping + plastic + breakage; }
  BondEnergy& operator+=(const BondEnergy& o);
};

/// Energies of the consecutive bonds [first, last) of one sort (all but what was damped and what broke). Broken bonds
/// hold no forces.
[[nodiscard]] BondEnergy energy_of(const Bonds& bonds, const BondConstants& constants, std::size_t first,
                                   std::size_t last);

}  // namespace lahar::dem
