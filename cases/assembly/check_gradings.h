#pragma once
#include <string>

#include "cases/scene/findings.h"
#include "cases/scene/scene.h"

namespace lahar::scene {

/// The gradings of the i-th packing, whose values have been read without a mistake.
void check_gradings(const Scene& scene, std::size_t i, Findings& findings);

/// Refuses a diameter (m) below a cell where grains are resolved: those do not feel the fluid. `is` joins key and
/// value.
void check_mapped_diameter(const Scene& scene, double diameter, const std::string& key, const std::string& is,
                           Findings& findings);

}  // namespace lahar::scene
