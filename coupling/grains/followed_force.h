#pragma once
// A body that follows the fluid's force (docs/decisions/0034).
#include <algorithm>

#include "core/vector.h"

namespace lahar::coupling {

/// Share of a new force in what a body feels. The liquid that a body holds answers a change of its velocity a step
/// late, and the liquid that it pushes aside within a few: m a_n = -M a_n-1 with M up to twice what it holds would grow
/// without bound for a light body. A force that follows the fluid's, F_n = F_n-1 + share (fluid - F_n-1), goes through
/// the factor 1 - share (1 + M / m) a step instead, here never below -1/2. It is the virtual mass m (1 / share - 1) of
/// Schwarz, Kempe & Froehlich 2015 (J. Comput. Phys. 281, 591): smooth motions lag by 1 / share steps, no inertia is
/// added. Bodies of four times the liquid they hold and more feel the force itself.
inline double followed_share(double own, double held) { return std::min(1.0, 1.5 * own / (own + 2 * held)); }

/// A body that holds no liquid forgets.
inline void follow(Vec3& felt, const Vec3& fluid, double share, bool wet) {
  felt = wet ? Vec3(felt + share * (fluid - felt)) : fluid;
}

}  // namespace lahar::coupling
