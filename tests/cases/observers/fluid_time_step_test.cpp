// The record of a time step that adapts.
#include "cases/observers/fluid_time_step.h"

#include "tests/cases/observers/heap_of_water.h"

namespace lahar::cases {
namespace {

using FluidTimeStepOfHeap = HeapOfWater;

/// The largest expected speed is ten times too large: the step grows.
TEST_F(FluidTimeStepOfHeap, TellsHowItsStepChanged) {
  const Metrics first = first_row({"fluid.adaptive_time_step=true", "fluid.max_speed_m_s=20"});
  const double start = 0.1 * 0.02 / 20;
  EXPECT_NEAR(first.at("fluid_time_step_min_s"), start, 1e-9 * start);
  EXPECT_EQ(first.at("fluid_time_step_changes"), 0);
  EXPECT_EQ(first.at("fluid_steps"), 0);
  const Metrics metrics = take_row(300);
  EXPECT_EQ(metrics.at("fluid_steps"), 300);
  EXPECT_NEAR(metrics.at("fluid_time_step_min_s"), start, 1e-9 * start);
  EXPECT_GT(metrics.at("fluid_time_step_max_s"), 1.2 * start);
  EXPECT_GE(metrics.at("fluid_time_step_max_s"), simulation_->fluid()->units().time_step);
  EXPECT_GE(metrics.at("fluid_time_step_changes"), 1);
  EXPECT_EQ(metrics.at("liquid_rescaled_kg"), simulation_->fluid()->transfers().rescaled);
  EXPECT_NE(metrics.at("liquid_rescaled_kg"), 0);
}

TEST_F(FluidTimeStepOfHeap, HasNothingToTellOfAFixedStep) {
  EXPECT_FALSE(first_row().contains("fluid_steps"));
  EXPECT_EQ(observers_->find<FluidTimeStep>(), nullptr);
}

}  // namespace
}  // namespace lahar::cases
