#pragma once
// The grains of a packing, size by size, with those that its gradings draw.
#include <vector>

#include "cases/scene/scene.h"
#include "dem/packing/grading.h"

namespace lahar::scene {

/// The distributions as the particles' room knows them.
dem::LogNormalSizes distribution_of(const LogNormalGrains& grains);
dem::SieveCurve distribution_of(const SievedGrains& grains);

/// Solid volume that is asked of a grading in this packing, m^3.
double solid_volume(const Packing& packing, const GrainAmount& amount, double density);

/// What the i-th packing holds: its sizes as listed, then one entry for each drawn grain. Fixed by run.seed. The scene
/// must be sound.
std::vector<GrainSize> grain_sizes(const Scene& scene, std::size_t i);

/// The same of all packings.
std::vector<GrainSize> grain_sizes(const Scene& scene);

}  // namespace lahar::scene
