#pragma once
// The packings of a scene.
#include <string>
#include <vector>

#include "cases/scene/scene.h"
#include "dem/particles.h"

namespace lahar::cases {

/// Packs the grains of all packings, in their order. Throws InputError, located at a packing, if its grains do not fit
/// or one of them lies in another packing.
void add_packings(const scene::Scene& scene, dem::Particles& particles);

/// As many grains as the packings have, anywhere.
void add_placeholders(const scene::Scene& scene, dem::Particles& particles);

/// Of the packings, whose grains are the first of `particles`, those that stand higher than they are to.
[[nodiscard]] std::vector<std::string> missed_heights(const scene::Scene& scene, const dem::Particles& particles);

}  // namespace lahar::cases
