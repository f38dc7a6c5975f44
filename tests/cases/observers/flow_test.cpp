// A heap of water on its way to a section: its energy, front and profile.
#include "cases/observers/flow.h"

#include "tests/cases/observers/heap_of_water.h"

namespace lahar::cases {
namespace {

using FlowOfHeap = HeapOfWater;

TEST_F(FlowOfHeap, EnergyFrontAndProfile) {
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

TEST_F(FlowOfHeap, HasArrivedAtASectionWithinIt) {
  const Metrics metrics = first_row({"measure.section_x_m=0.2"});
  EXPECT_EQ(metrics.at("front_arrival_s"), 0);
  const FlowFigures& f = observers_->find<Flow>()->now();  // outflow section at 0.3
  EXPECT_NEAR(f.outflow_rate, 1000 * 0.5 * 0.16 * 0.3, 0.01 * f.outflow_rate);
}

/// The last cells of a domain of no whole cells end beyond it.
TEST_F(FlowOfHeap, FrontsEndWithTheDomain) {
  first_row({"domain.upper_m=[0.395, 0.16, 0.5]", "measure.section_x_m=0.2",
             "fluid.region=[{lower_m = [0, 0, 0], upper_m = [0.395, 0.16, 0.3]}]"});
  EXPECT_NEAR(observers_->find<Flow>()->now().front, 0.395, 1e-9);
}

/// A channel of half the domain's width, its floor 0.1 m above the domain's: front and depth are those of the channel.
TEST_F(FlowOfHeap, ChannelsMayBeNarrowAndHigh) {
  first_row(
      {"wall=[{name = \"floor\", shape = \"box\", lower_m = [0, 0, 0], upper_m = [1, 0.16, 0.1]}, "
       "{name = \"side\", shape = \"box\", lower_m = [0, 0.08, 0], upper_m = [1, 0.16, 0.42]}]",
       "fluid.region=[{lower_m = [0, 0, 0.1], upper_m = [0.4, 0.08, 0.3], velocity_m_s = [0.5, 0, 0]}]"});
  const FlowFigures& f = observers_->find<Flow>()->now();
  EXPECT_NEAR(f.front, 0.4, 1e-9);
  EXPECT_NEAR(f.deepest, 0.2, 2e-3);
  EXPECT_NEAR(f.deepest_speed, 0.5, 1e-6);
}

/// A gate that has opened is no bed: the front goes on as if none had been there.
TEST_F(FlowOfHeap, GoesOnWhereAGateHasOpened) {
  const auto front_after = [&](int steps, const std::vector<std::string>& set) {
    first_row(set);
    take_row(steps);
    return observers_->find<Flow>()->now().front;
  };
  const std::string still = "fluid.region=[{lower_m = [0, 0, 0], upper_m = [0.4, 0.16, 0.3]}]";
  const std::string gate =
      "wall=[{name = \"gate\", shape = \"plane\", point_m = [0.4, 0, 0], normal = [-1, 0, 0], opens_at_s = 1e-9}]";
  const double free = front_after(150, {still}), opened = front_after(151, {still, gate});
  EXPECT_GT(free, 0.5);
  EXPECT_NEAR(opened, free, 0.02);
}

}  // namespace
}  // namespace lahar::cases
