#pragma once
// Elastic energy of single contacts, for events that make or end a contact all at once: a bond that breaks between
// beads that press on each other, a particle that is taken out.
#include "core/geometry.h"
#include "dem/contact/contact_detection.h"
#include "dem/contact/contact_forces.h"
#include "dem/material.h"
#include "dem/particles.h"

namespace lahar::dem {

/// Energy that the normal springs of particle i's contacts hold, J.
[[nodiscard]] double normal_energy_of(ParticleIndex i, const Particles& particles, const Materials& materials,
                                      const Walls& walls, const ContactDetection& contacts,
                                      const ContactLawChoice& law);

/// Energy that a contact of spheres i and j would hold with this overlap (m), J; 0 if they are apart.
[[nodiscard]] double normal_energy(ParticleIndex i, ParticleIndex j, double overlap, const Particles& particles,
                                   const Materials& materials, const ContactLawChoice& law);

}  // namespace lahar::dem
