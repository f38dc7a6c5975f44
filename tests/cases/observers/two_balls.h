#pragma once
// A large ball before a section at 0.6 m and a small one behind it, as text.
#include <string>

#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {

inline const std::string two_balls = scene::small_scene + R"(velocity_m_s = [2, 0, 0]
[[grains.sphere]]
position_m = [0.8, 0.5, 0.2]
diameter_m = 0.05
density_kg_m3 = 2500
material = "rock"
[measure]
section_x_m = 0.6
inflow_distance_m = 0.1
outflow_distance_m = 0.1
)";

}  // namespace lahar::cases
