#pragma once
// A force of the fluid that is no number stops the run, with the particle's place.
#include <cstdio>

#include "core/check.h"
#include "dem/particles.h"

namespace lahar::coupling {

/// `what`: "grain" or "bead".
inline void require_finite_force(const dem::Particles& particles, dem::ParticleIndex i, const char* what,
                                 std::int64_t step) {
  if (particles.external_force[i].allFinite()) return;
  const Vec3 p = particles.position[i];
  char where[112];
  std::snprintf(where, sizeof where, "%s %u at (%.4g, %.4g, %.4g) m", what, particles.id(i), p.x(), p.y(), p.z());
  throw NumericalFailure(where, step, "the force of the fluid on it is not finite");
}

}  // namespace lahar::coupling
