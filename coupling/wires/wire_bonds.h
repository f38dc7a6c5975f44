#pragma once
// Which bonds are pieces of a wire.
#include <algorithm>

#include "dem/bonds/bonds.h"

namespace lahar::coupling {

/// Bonds between beads, but not links (barrier/link.h), which have hardly a section: ties, joints, and the wires of a
/// mesh, whose nodes are far apart.
inline bool is_wire(const dem::Particles& particles, const dem::Bonds& bonds, std::size_t k) {
  const dem::ParticleIndex i = bonds.i[k], j = bonds.j[k];
  if (particles.kind[i] != dem::ParticleKind::bead || particles.kind[j] != dem::ParticleKind::bead) return false;
  const double section = bonds.sorts[static_cast<std::size_t>(bonds.sort[k])].bond_radius;
  return section >= 0.01 * std::min(particles.radius[i], particles.radius[j]);
}

/// m, of the cylinder that a bond stands for.
inline double wire_diameter(const dem::Particles& particles, const dem::Bonds& bonds, std::size_t k) {
  return particles.radius[bonds.i[k]] + particles.radius[bonds.j[k]];
}

}  // namespace lahar::coupling
