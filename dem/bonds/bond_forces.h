#pragma once
// Forces and moments of parallel bonds (Potyondy & Cundall 2004, section 2.3; Li, Zhao & Kwan 2020, section 2.1).
#include <cstddef>
#include <vector>

#include "core/vector.h"
#include "dem/bonds/bond_constants.h"
#include "dem/bonds/bond_energy.h"
#include "dem/bonds/bond_layout.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"

namespace lahar::dem {

/// Computes what the bonds do to their particles. Holds constants and scratch space only: all that a restart needs lies
/// in `Bonds`.
class BondForces {
 public:
  /// Prepares for these bonds. Call again after bonds were added or masses changed. Throws std::logic_error for a bond
  /// sort that makes no sense (see axial_curve) or an end that does not exist.
  void build(const Bonds& bonds, const Particles& particles);

  /// Carries the bonds over a time step of dt seconds that has brought the particles to their present positions, and
  /// adds forces and torques. Angular velocities must be those of the middle of that step, as in a
  /// half-kick-drift-half-kick scheme between the kicks. With dt = 0 the ends count as not having turned (first
  /// evaluation). The critical time step is the caller's business, and so is cutting (`intact` = 0) the bonds of a
  /// particle that is taken out. Deterministic for any number of threads.
  void add_forces(Bonds& bonds, Particles& particles, double dt);

  /// The particles were renumbered, and the bonds know where their ends stand.
  void find_ends(const Bonds& bonds) { layout_.find_ends(bonds); }

  /// Energies of these bonds, which must be those that were built, after the last call of add_forces. Summed when asked
  /// for, in an order that does not depend on the number of threads.
  [[nodiscard]] BondEnergy energy(const Bonds& bonds) const;

  /// Square roots of the effective mass (kg^1/2) and inertia (kg^1/2 m) of each bond's modes, for damping.
  struct EffectiveMasses {
    std::vector<double> axial, shear, inertia;
  };

 private:
  struct Loss {  // J, of this step
    double damping = 0, breakage = 0;
  };

  void build_effective_masses(const Bonds& bonds, const Particles& particles);
  void advance_chunk(std::size_t chunk, Bonds& bonds, Particles& particles, double dt);

  std::vector<BondConstants> constants_;
  EffectiveMasses masses_;
  BondLayout layout_;
  std::vector<Loss> losses_;  // per chunk
  std::size_t size_ = 0;
};

}  // namespace lahar::dem
