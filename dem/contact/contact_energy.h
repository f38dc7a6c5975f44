#pragma once
// Elastic energy of contacts: of all of them, for the ledger, and of single ones, for events that make or end a contact
// all at once: a bond that breaks between beads that press on each other, a particle that is taken out.
#include "core/geometry.h"
#include "dem/contact/contact_detection.h"
#include "dem/contact/contact_forces.h"
#include "dem/material.h"
#include "dem/particles.h"

namespace lahar::dem {

/// Energies of touching contacts now, J.
struct EnergyNow {
  double normal = 0, tangential = 0;  ///< what springs hold
  /// What normal dampers took in the half kick that is done of their last step, less half of what they take in all of
  /// it: d F h^2/(2 m*) with h = dt/2, as the closing speed falls by F h/m* in a half kick. Large where a strong damper
  /// has just begun to act.
  double damped_ahead = 0;
};

/// Of all contacts of spheres with each other and with walls, as they were evaluated last in a step of dt (s); the
/// normal springs of removed particles do not count. Summed in the order of ids.
[[nodiscard]] EnergyNow energy_now(const Particles& particles, const Materials& materials, const Walls& walls,
                                   const ContactDetection& contacts, const ContactLawChoice& law, double dt);

/// Energy that the normal springs of particle i's contacts hold, J.
[[nodiscard]] double normal_energy_of(ParticleIndex i, const Particles& particles, const Materials& materials,
                                      const Walls& walls, const ContactDetection& contacts,
                                      const ContactLawChoice& law);

/// Energy that a contact of spheres i and j would hold with this overlap (m), J; 0 if they are apart.
[[nodiscard]] double normal_energy(ParticleIndex i, ParticleIndex j, double overlap, const Particles& particles,
                                   const Materials& materials, const ContactLawChoice& law);

}  // namespace lahar::dem
