#pragma once
// The force of the fluid on a body, under-relaxed from step to step (docs/decisions/0034).
#include <algorithm>

#include "core/vector.h"

namespace lahar::coupling {

/// Factor of under-relaxation for a body of inertia `own` that entrains liquid of inertia `entrained`. The entrained
/// liquid answers a change of the body's velocity a step late, and the liquid that it pushes aside within a few:
/// m a_n = -M a_n-1 with M up to twice what is entrained would grow without bound for a light body. A force that is
/// relaxed, F_n = F_n-1 + factor (fluid - F_n-1), goes through the factor 1 - factor (1 + M / m) a step instead, here
/// never below -1/2. It is the virtual mass m (1 / factor - 1) of Schwarz, Kempe & Froehlich 2015 (J. Comput. Phys.
/// 281, 591): smooth motions lag by 1 / factor steps, no inertia is added. Bodies of four times the entrained liquid
/// and more feel the force itself.
inline double relaxation_factor(double own, double entrained) {
  return std::min(1.0, 1.5 * own / (own + 2 * entrained));
}

/// A body that entrains no liquid forgets.
inline void under_relax(Vec3& felt, const Vec3& fluid, double factor, bool entrains) {
  felt = entrains ? Vec3(felt + factor * (fluid - felt)) : fluid;
}

}  // namespace lahar::coupling
