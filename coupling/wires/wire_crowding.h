#pragma once
// How much of a plane the wires around a bead cover: the solidity of the screen that a wire is part of. Purely
// geometrical, so that it does not depend on cells or flow.
#include <vector>

#include "core/vector.h"

namespace lahar::coupling {

/// A piece of wire.
struct WireSegment {
  Vec3 place = Vec3::Zero();   ///< m, of its middle
  Vec3 along = Vec3::UnitX();  ///< unit
  double diameter = 0;         ///< m
  double length = 0;           ///< m
};

/// What a piece has around it, in its plane.
struct Crowding {
  double area = 0;      ///< diameter x length of all wires per area of the plane, crossings counted twice
  double parallel = 0;  ///< the part of it that runs along the piece
  double solidity = 0;  ///< covered share of the plane
};

/// How far a wire sees its neighbours, in its own diameters.
inline constexpr double kCrowdingReach = 16;

/// The area (diameter x length) of the pieces within R = 16 diameters, weighted by 1 - r^2/R^2, over the weighted area
/// of the disc, pi R^2/2. A lone straight wire by itself would count as 8 d/(3 pi R) = 0.053; that is taken off until
/// the neighbours make up as much, so that a lone wire has 0 and a plane screen its true value. Parts along the wire
/// (cos^2 of the angle between them) and across it cover each other where they cross: S = 1 - (1 - along)(1 - across),
/// exact for parallel wires and for square meshes. At most 0.7. `period` is the length (m) after which an axis repeats,
/// 0 for none.
std::vector<Crowding> wire_crowding(const std::vector<WireSegment>& pieces, const Vec3& period);

}  // namespace lahar::coupling
