// Liquid and energy that pass a section: rates of the rows times their intervals.
#include "cases/observers/outflow.h"

#include "tests/cases/observers/heap_of_water.h"

namespace lahar::cases {
namespace {

using OutflowOfHeap = HeapOfWater;

TEST_F(OutflowOfHeap, PassesTheOutflowSection) {
  first_row({"measure.section_x_m=0.2"});  // outflow section at 0.3
  const Outflow& outflow = *observers_->find<Outflow>();
  EXPECT_EQ(outflow.energy(), 0);  // nothing passes in no time
  double mass = 0, energy = 0;
  for (int row = 0; row < 4; ++row) {
    const double start = simulation_->time();
    const Metrics metrics = take_row(5);
    const FlowFigures& f = observers_->find<Flow>()->now();
    EXPECT_GT(f.outflow_rate, 0);
    mass += f.outflow_rate * (simulation_->time() - start), energy += f.outflow_power * (simulation_->time() - start);
    EXPECT_NEAR(metrics.at("liquid_passed_kg"), mass, 1e-12 * mass);
    EXPECT_NEAR(outflow.energy(), energy, 1e-12 * energy);
  }
  // A rectangle of 0.3 m x 0.16 m at half a metre a second.
  EXPECT_NEAR(mass, 1000 * 0.3 * 0.16 * 0.5 * simulation_->time(), 0.15 * mass);
}

}  // namespace
}  // namespace lahar::cases
