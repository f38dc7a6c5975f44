#pragma once
// How much of a plane the wires around a bead cover: the solidity of the screen that a wire is part of. Purely
// geometrical, so that it does not depend on cells or flow.
#include <vector>

#include "core/vector.h"

namespace lahar::coupling {

/// A piece of wire.
struct WirePiece {
  Vec3 place = Vec3::Zero();  ///< m, of its middle
  double diameter = 0;        ///< m
  double length = 0;          ///< m
};

/// How far a wire sees its neighbours, in its own diameters.
inline constexpr double kCrowdingReach = 16;

/// Solidity at every piece: the area (diameter x length) of the pieces within R = 16 diameters, weighted by
/// 1 - r^2/R^2, over the weighted area of the disc, pi R^2/2. A lone straight wire by itself would count as 8 d/(3 pi R)
/// = 0.053; that is taken off until the neighbours make up as much, so that a lone wire has 0 and a plane screen its
/// true value. At most 0.7. `period` is the length (m) after which an axis repeats, 0 for none.
std::vector<double> wire_solidity(const std::vector<WirePiece>& pieces, const Vec3& period);

}  // namespace lahar::coupling
