#pragma once
// Whether particles as a run begins with them are clear of each other.
#include "cases/scene/scene.h"
#include "dem/particles.h"

namespace lahar::cases {

/// Throws InputError where spheres reach into packed grains, or grains into the barrier, by more than
/// scene::kLargestOverlap of the smaller radius: they would burst apart. Located at the sphere, of packed grains at the
/// barrier. What `check` finds without packing and hanging is not all: single grains stand out of a packing of a
/// `target_height_m`, and nets sag as they come to rest.
/// @param particles  those of packings, then spheres, then beads
void require_clear_start(const scene::Scene& scene, const dem::Particles& particles);

}  // namespace lahar::cases
