#pragma once
// Whether particles as a run begins with them are clear of each other.
#include <string>

#include "cases/scene/scene.h"
#include "dem/solids.h"

namespace lahar::cases {

/// Throws InputError where spheres reach into packed grains, grains into the barrier or packed grains into walls, by
/// more than scene::kLargestOverlap of the smaller radius: they would burst apart. Located at the sphere, at the
/// barrier, at the packing. What `check` finds without packing and hanging is not all: single grains stand out of a
/// packing of a `target_height_m`, nets sag as they come to rest, and walls may be thinner than `check` can see.
/// @param particles  those of packings, then spheres, then beads
void require_clear_start(const scene::Scene& scene, const dem::Particles& particles);

/// What to tell of particles that begin pressed into each other or into walls so far that their springs would throw one
/// at more than 1 m/s; "" if none. Hertz' springs hold W = 8/15 E* sqrt(R*) overlap^2.5: grains as stiff as rock (5e10
/// Pa, 10 cm) part at 2 m/s from a hundredth of a radius, at 37 from a tenth.
std::string burst_at_start(const dem::Solids& solids);

}  // namespace lahar::cases
