#pragma once
// An order of particles in which those that are near each other in space are near each other in memory.
#include "dem/particles.h"

namespace lahar::dem {

/// Particles along a Morton curve (Morton 1966) through cells as wide as the largest particle, by id within a cell.
/// Beads of one body that follow each other by id, as along a ring or cable, stay together, at the cell of their first
/// bead: their bonds then need no indices (BondLayout::Link). What was removed comes last. Positions must be finite.
[[nodiscard]] Renumbering spatial_order(const Particles& particles);

}  // namespace lahar::dem
