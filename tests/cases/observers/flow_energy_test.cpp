// Energy and Froude numbers of a flow that arrives at a section.
#include "cases/observers/flow_energy.h"

#include <cmath>

#include "tests/cases/observers/heap_of_water.h"

namespace lahar::cases {
namespace {

using FlowEnergyOfHeap = HeapOfWater;

TEST_F(FlowEnergyOfHeap, ArrivesWithinTheInflowDistance) {
  const Metrics metrics = first_row();  // the front is 0.1 m away
  const FlowFigures& f = observers_->find<Flow>()->now();
  EXPECT_EQ(metrics.at("e_in_kJ"), (f.kinetic + f.potential) / 1000);
  EXPECT_NEAR(metrics.at("froude_deepest_section"), 0.5 / std::sqrt(9.81 * 0.3), 0.005);
  EXPECT_NEAR(metrics.at("froude_mean_speed"), 0.5 / std::sqrt(9.81 * 0.3), 0.005);
  EXPECT_NEAR(metrics.at("depth_at_inflow_m"), 0.3, 1e-3);
  EXPECT_FALSE(metrics.contains("front_arrival_s"));
  EXPECT_FALSE(metrics.contains("e_out_kJ"));  // without solids
}

TEST_F(FlowEnergyOfHeap, IsFarFromASectionFurtherDown) {
  const Metrics metrics = first_row({"measure.section_x_m=0.8"});
  EXPECT_FALSE(metrics.contains("e_in_kJ"));
}

/// The first row within reach counts, later ones do not.
TEST_F(FlowEnergyOfHeap, ArrivesOnce) {
  const Metrics first = first_row();
  take_row(20);
  EXPECT_NE(observers_->find<Flow>()->now().kinetic, 0);
  EXPECT_EQ(observers_->metrics().at("e_in_kJ"), first.at("e_in_kJ"));
  EXPECT_EQ(observers_->metrics().at("depth_at_inflow_m"), first.at("depth_at_inflow_m"));
}

}  // namespace
}  // namespace lahar::cases
