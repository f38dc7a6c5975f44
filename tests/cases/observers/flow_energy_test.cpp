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

/// On a bed of 35 degrees: two heaps, 0.3 m deep at 0.5 m/s and 0.1 m deep at 1.5 m/s, and a grain that flies. Half a
/// step of gravity is in the liquid's velocity.
TEST_F(FlowEnergyOfHeap, OnASlopeWithHeapsOfTwoSpeedsAndAGrain) {
  const Metrics metrics =
      first_row({"gravity.slope_deg=35",
                 "fluid.region=[{lower_m = [0, 0, 0], upper_m = [0.2, 0.16, 0.3], velocity_m_s = [0.5, 0, 0]}, "
                 "{lower_m = [0.2, 0, 0], upper_m = [0.4, 0.16, 0.1], velocity_m_s = [1.5, 0, 0]}]",
                 "materials={rock = {youngs_modulus_Pa = 1e7, poisson_ratio = 0.3}}",
                 "contact=[{materials = [\"rock\", \"rock\"], friction = 0.5, restitution = 0.3}]",
                 "grains.sphere=[{position_m = [0.3, 0.08, 0.35], velocity_m_s = [1, 0, 0], diameter_m = 0.1, "
                 "density_kg_m3 = 2500, material = \"rock\"}]"});
  const double g = 9.81, angle = 35 * M_PI / 180, c = std::cos(angle), s = std::sin(angle);
  const double half_step = 0.5 * simulation_->fluid()->units().time_step * g;
  const double deep = 9.6, shallow = 3.2, grain = 2500 * M_PI / 6 * 1e-3;  // kg
  const auto energy = [&](double mass, double speed, double falls, double x, double z) {
    const double kinetic = 0.5 * mass * (std::pow(speed + falls * s, 2) + std::pow(falls * c, 2));
    return kinetic + mass * g * ((0.5 - x) * s + (z - 0.05) * c);
  };
  const double expected = energy(deep, 0.5, half_step, 0.1, 0.15) + energy(shallow, 1.5, half_step, 0.3, 0.05) +
                          energy(grain, 1, 0, 0.3, 0.35);
  EXPECT_NEAR(1000 * metrics.at("e_in_kJ") / expected, 1, 0.01);
  EXPECT_NEAR(metrics.at("depth_at_inflow_m"), 0.3, 1e-3);
  const double wave = std::sqrt(g * c * 0.3), mean = (deep * 0.5 + shallow * 1.5) / (deep + shallow);
  EXPECT_NEAR(metrics.at("froude_deepest_section"), (0.5 + half_step * s) / wave, 0.005);
  EXPECT_NEAR(metrics.at("froude_mean_speed"), (mean + half_step * s) / wave, 0.01);
}

/// What passes the outflow section takes its energy out: the liquid's, and that of a ball that flies over it.
TEST_F(FlowEnergyOfHeap, WhatPassesTakesItsEnergyOut) {
  first_row({"measure.section_x_m=0.2", "materials={rock = {youngs_modulus_Pa = 1e7, poisson_ratio = 0.3}}",
             "contact=[{materials = [\"rock\", \"rock\"], friction = 0.5, restitution = 0.3}]",
             "grains.sphere=[{position_m = [0.29, 0.08, 0.42], velocity_m_s = [2, 0, 0], diameter_m = 0.1, "
             "density_kg_m3 = 2500, material = \"rock\"}]"});
  const Metrics metrics = take_row(20);
  const double mass = 2500 * M_PI / 6 * 1e-3, ball = mass * (0.5 * 2 * 2 + 9.81 * (0.42 - 0.05)) / 1000;
  EXPECT_GT(metrics.at("e_out_liquid_kinetic_kJ"), 0);
  EXPECT_NEAR(metrics.at("e_out_kJ") - metrics.at("e_out_liquid_kinetic_kJ") - metrics.at("e_out_liquid_potential_kJ"),
              ball, 1e-3 * ball);
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
