#pragma once
// The deepest contact.
#include "core/geometry.h"
#include "dem/contact/contact_detection.h"
#include "dem/particles.h"

namespace lahar::dem {

struct WorstOverlap {
  double ratio = 0;  ///< overlap over the smaller radius
  ParticleId particle = 0;
  std::uint32_t partner = 0;  ///< id of a particle, or number of a wall
  bool with_wall = false;
};

/// Looks at all contacts that touched in the last evaluation, where the particles are now. Ties go to the lowest id.
[[nodiscard]] WorstOverlap worst_overlap(const Particles& particles, const ContactDetection& contacts,
                                         const Walls& walls);

}  // namespace lahar::dem
