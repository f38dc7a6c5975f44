#pragma once
// A tank of water, and one with a ball in it as a wall, as text.
#include <string>

namespace lahar::cases {

inline const std::string tank_of_water = R"([scene]
name = "tank"
[run]
duration_s = 0.3
precision = "double"
[domain]
lower_m = [0, 0, 0]
upper_m = [0.32, 0.16, 0.4]
open_faces = ["z+"]
[fluid]
enabled = true
cell_size_m = 0.01
kinematic_viscosity_m2_s = 1e-3
[[fluid.region]]
lower_m = [0, 0, 0]
upper_m = [0.32, 0.16, 0.3]
)";

inline const std::string tank_with_ball = tank_of_water + R"([[wall]]
name = "ball"
shape = "sphere"
centre_m = [0.16, 0.08, 0.1]
radius_m = 0.05
)";

}  // namespace lahar::cases
