#pragma once
// What the particle benchmarks run: grains at rest in a box, and a hanging ring net.
#include "dem/solids.h"

namespace lahar::performance {

/// The one material pair of a benchmark scene, as both codes are told.
struct ScenePair {
  double youngs_modulus, poisson_ratio, friction, restitution;
};
inline constexpr ScenePair kRock{1e8, 0.25, 0.5, 0.5};
inline constexpr ScenePair kSteel{1e9, 0.3, 0.3, 0.3};

/// `count` grains of 20 and 40 mm radius, half of the volume each, settled under gravity in a box open at the top.
dem::Solids settled_grains(int count);

/// 480 rings of 36 beads without cables, interlocked, the uppermost row held: hangs until rings bear on each other.
dem::Solids hanging_rings();

}  // namespace lahar::performance
