#pragma once
// The energy ledger of the particles: what is stored, what was lost, what came from outside.
#include <array>
#include <string_view>
#include <utility>

#include "core/vector.h"
#include "dem/bonds/bond_forces.h"
#include "dem/contact/contact_forces.h"
#include "dem/particles.h"

namespace lahar::dem {

/// All in J. total() stays constant but for the error of the time step.
struct EnergyLedger {
  // stored now
  double kinetic = 0, rotational = 0;
  double gravitational = 0;                                                ///< about the origin
  double elastic_normal = 0, elastic_tangential = 0, elastic_rolling = 0;  ///< of contacts
  BondEnergy bonds;  ///< stored: axial, shear, bending, torsion; lost: the rest
  // lost since the start
  double contact_damping = 0, friction = 0, rolling = 0;  ///< of contacts: dampers, sliding, rolling
  double removed = 0;  ///< carried away by removed particles, or held by springs at a wall that opened
  // gained since the start
  double external_work = 0;  ///< of external forces (fluid) and moving walls

  [[nodiscard]] double stored() const {
    return kinetic + rotational + gravitational + elastic_normal + elastic_tangential + elastic_rolling +
           bonds.elastic();
  }
  [[nodiscard]] double dissipated() const { return contact_damping + friction + rolling + bonds.dissipated(); }
  [[nodiscard]] double total() const { return stored() + dissipated() + removed - external_work; }
  /// Every term once, by name; those that came in count negative, so that they add up to total().
  [[nodiscard]] std::array<std::pair<std::string_view, double>, 18> terms() const;
};

/// Kinetic, rotational and gravitational energy of all particles, summed in the order of their ids: independent of the
/// number of threads and of the numbering.
EnergyLedger motion_energy(const Particles& particles, const Vec3& gravity);

/// Kinetic + rotational + gravitational energy of one particle, J.
double motion_energy(const Particles& particles, std::size_t i, const Vec3& gravity);

/// Work of the external forces over a drift of dt (s) with the present (mid-step) velocities, J.
double external_work(const Particles& particles, double dt);

/// In the order of ids: total momentum, kg m/s, and angular momentum about the origin, kg m^2/s, of all free particles.
Vec3 momentum(const Particles& particles);
Vec3 angular_momentum(const Particles& particles);

}  // namespace lahar::dem
