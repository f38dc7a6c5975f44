#pragma once
// What is allowed in a scene but probably not meant, or not well resolved.
#include <string>
#include <vector>

#include "cases/runner/check.h"
#include "cases/scene/scene.h"

namespace lahar::cases {

/// One sentence for each doubt about a scene with these figures.
std::vector<std::string> warnings(const scene::Scene& scene, const CheckReport& figures);

}  // namespace lahar::cases
