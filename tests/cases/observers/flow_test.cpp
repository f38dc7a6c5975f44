// A heap of water on its way to a section: its energy, front and profile, and what follows from them.
#include "cases/observers/flow.h"

#include <gtest/gtest.h>

#include "cases/observers/observer_list.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

const std::string heap = R"([scene]
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
    scene_ = scene::load_text(heap, set);
    simulation_ = build_simulation(scene_);
    observers_ = std::make_unique<ObserverList>(scene_, *simulation_);
    SeriesWriter series(scratch_.path() / "series.h5");
    observers_->declare(series);
    observers_->sample(series);
    return observers_->metrics();
  }
  scene::ScratchFolder scratch_;
  scene::Scene scene_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<ObserverList> observers_;
};

TEST_F(HeapOfWater, EnergyFrontAndProfile) {
  first_row();
  const double mass = 1000 * 0.4 * 0.16 * 0.3;
  const double fall = 0.5 * simulation_->fluid()->units().time_step * 9.81;  // half a step of gravity is in it
  const FlowFigures& f = observers_->find<Flow>()->now();
  EXPECT_NEAR(f.kinetic, 0.5 * mass * (0.25 + fall * fall), 1e-3 * f.kinetic);
  EXPECT_NEAR(f.potential, mass * 9.81 * (0.15 - 0.05), 0.01 * f.potential);
  EXPECT_NEAR(f.momentum.x(), mass * 0.5, 1e-3 * mass);
  EXPECT_NEAR(f.front, 0.4, 1e-9);
  EXPECT_NEAR(f.deepest, 0.3, 1e-3);
  EXPECT_NEAR(f.deepest_speed, 0.5, 1e-6);
  EXPECT_EQ(f.outflow_rate, 0);
}

TEST_F(HeapOfWater, ArrivesWithinTheInflowDistance) {
  const Metrics metrics = first_row();  // the front is 0.1 m away
  const FlowFigures& f = observers_->find<Flow>()->now();
  EXPECT_EQ(metrics.at("e_in_kJ"), (f.kinetic + f.potential) / 1000);
  EXPECT_NEAR(metrics.at("froude_deepest_section"), 0.5 / std::sqrt(9.81 * 0.3), 0.005);
  EXPECT_NEAR(metrics.at("froude_mean_speed"), 0.5 / std::sqrt(9.81 * 0.3), 0.005);
  EXPECT_NEAR(metrics.at("depth_at_inflow_m"), 0.3, 1e-3);
  EXPECT_FALSE(metrics.contains("front_arrival_s"));
  EXPECT_FALSE(metrics.contains("e_out_kJ"));  // without solids
}

TEST_F(HeapOfWater, IsFarFromASectionFurtherDown) {
  const Metrics metrics = first_row({"measure.section_x_m=0.8"});
  EXPECT_FALSE(metrics.contains("e_in_kJ"));
}

TEST_F(HeapOfWater, HasArrivedAtASectionWithinIt) {
  const Metrics metrics = first_row({"measure.section_x_m=0.2"});
  EXPECT_EQ(metrics.at("front_arrival_s"), 0);
  const FlowFigures& f = observers_->find<Flow>()->now();  // outflow section at 0.3
  EXPECT_NEAR(f.outflow_rate, 1000 * 0.5 * 0.16 * 0.3, 0.01 * f.outflow_rate);
}

}  // namespace
}  // namespace lahar::cases
