#pragma once
// The space that grains of a scene take up at the start.
#include "cases/scene/scene.h"

namespace lahar::scene {

/// Of the smaller radius: grains that overlap more at the start would burst apart.
inline constexpr double kLargestOverlap = 0.1;

/// m/s, of anything solid: a run in which something is faster stops. Nothing in a debris flow is.
inline constexpr double kLargestSpeed = 200;

/// m^3 of grains in a packing.
double solid_volume(const Packing& packing);
/// Upper corner of the part of a packing's box that its grains will fill, once they have settled: their volume, and a
/// grain on top.
Vec3 upper_of_content(const Packing& packing);

}  // namespace lahar::scene
