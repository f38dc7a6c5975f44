#pragma once
#include "cases/scene/findings.h"
#include "cases/scene/scene.h"

namespace lahar::scene {

/// The gradings of the i-th packing, whose values have been read without a mistake.
void check_gradings(const Scene& scene, std::size_t i, Findings& findings);

}  // namespace lahar::scene
