#pragma once
// Whether particles as a run begins with them are clear of each other.
#include "cases/scene/scene.h"
#include "dem/particles.h"

namespace lahar::cases {

/// Throws InputError where spheres reach into packed grains, grains into the barrier or packed grains into walls, by
/// more than scene::kLargestOverlap of the smaller radius: they would burst apart. Located at the sphere, at the
/// barrier, at the packing. What `check` finds without packing and hanging is not all: single grains stand out of a
/// packing of a `target_height_m`, nets sag as they come to rest, and walls may be thinner than `check` can see.
/// @param particles  those of packings, then spheres, then beads
void require_clear_start(const scene::Scene& scene, const dem::Particles& particles);

}  // namespace lahar::cases
