#pragma once
// Random packs of equal spheres in a periodic cube.
#include <vector>

#include "core/vector.h"

namespace lahar::validate {

/// Centres of `count` spheres in the cube [0, box)^3: pushed apart until none overlap, then moved at random, none ever
/// into another (Metropolis et al. 1953). What pushing alone leaves, pairs that almost touch beside voids, makes a pack
/// up to a third more permeable. Up to a volume fraction of 0.6.
std::vector<Vec3> hard_spheres(std::size_t count, double box, double diameter, unsigned seed);

/// The largest overlap in a jammed pack, of the diameter.
inline constexpr double kJammedOverlap = 0.03;

/// Beyond that, where a random pack jams (0.64): pushed apart until no overlap is larger than kJammedOverlap. No room
/// to shake it is left.
std::vector<Vec3> jammed_spheres(std::size_t count, double box, double diameter, unsigned seed);

}  // namespace lahar::validate
