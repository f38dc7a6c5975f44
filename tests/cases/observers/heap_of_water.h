#pragma once
// A heap of water on its way to a section, as several tests look at it.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "tests/cases/observers/sampled.h"

namespace lahar::cases {

inline const std::string heap_of_water = R"([scene]
name = "heap"
[run]
duration_s = 1.0
precision = "double"
[domain]
lower_m = [0, 0, 0]
upper_m = [1, 0.16, 0.5]
open_faces = ["z+"]
[fluid]
enabled = true
cell_size_m = 0.02
max_speed_m_s = 2.0
[[fluid.region]]
lower_m = [0, 0, 0]
upper_m = [0.4, 0.16, 0.3]
velocity_m_s = [0.5, 0, 0]
[measure]
section_x_m = 0.5
inflow_distance_m = 0.15
outflow_distance_m = 0.1
energy_datum_z_m = 0.05
)";

class HeapOfWater : public testing::Test {
 protected:
  /// Takes a row of the scene as it begins.
  Metrics first_row(const std::vector<std::string>& set = {}) {
    run_.emplace(scene::load_text(heap_of_water, set));
    simulation_ = run_->simulation.get();
    observers_ = &run_->observers;
    return take_row(0);
  }
  /// Takes a row after so many steps.
  Metrics take_row(int steps) {
    run_->take_row(steps);
    return run_->metrics();
  }
  std::optional<Sampled> run_;
  Simulation* simulation_ = nullptr;
  const ObserverList* observers_ = nullptr;
};

}  // namespace lahar::cases
