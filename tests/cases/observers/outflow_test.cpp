// Liquid and energy that pass a section: mass by the ledger, energy by what crosses.
#include "cases/observers/outflow.h"

#include <fmt/format.h>

#include <cmath>

#include "tests/cases/observers/heap_of_water.h"

namespace lahar::cases {
namespace {

using OutflowOfHeap = HeapOfWater;

TEST_F(OutflowOfHeap, PassesTheOutflowSection) {
  first_row({"measure.section_x_m=0.2"});  // outflow section at 0.3
  const Outflow& outflow = *observers_->find<Outflow>();
  EXPECT_EQ(outflow.energy().sum(), 0);  // nothing passes in no time
  const double beyond = observers_->find<Flow>()->now().beyond_outflow;
  EXPECT_NEAR(beyond, 1000 * 0.1 * 0.16 * 0.3, 0.01 * beyond);
  double mass = 0, energy = 0, kinetic = 0, passed = 0;
  for (int row = 0; row < 4; ++row) {
    const double start = simulation_->time();
    const Metrics metrics = take_row(5);
    const FlowFigures& f = observers_->find<Flow>()->now();
    EXPECT_GT(f.outflow_rate, 0);
    const double interval = simulation_->time() - start;
    mass += f.outflow_rate * interval, energy += f.outflow_power * interval;
    kinetic += f.outflow_kinetic_power * interval;
    passed = metrics.at("liquid_passed_kg");
    EXPECT_NEAR(passed, f.beyond_outflow - beyond, 1e-9 * mass);
    EXPECT_NEAR(outflow.energy().sum(), passed * energy / mass, 1e-9 * energy);
    EXPECT_NEAR(metrics.at("e_out_liquid_kinetic_kJ"), passed * kinetic / mass / 1000, 1e-12 * energy);
  }
  // A rectangle of 0.3 m x 0.16 m at half a metre a second.
  EXPECT_NEAR(passed, 1000 * 0.3 * 0.16 * 0.5 * simulation_->time(), 0.15 * passed);
  EXPECT_NEAR(passed, mass, 0.1 * passed);  // cells of the surface are in both, by their levels
}

/// A plug, 0.3 m deep at half a metre a second: its rate times v^2/2 and g h of its middle over the datum, 0.05 m above
/// the bed on the measured section, 0.1 m upstream. The planes run through centres of cells.
TEST_F(OutflowOfHeap, CarriesItsKineticAndPotentialEnergy) {
  for (const double slope : {0.0, 35.0}) {
    first_row({"measure.section_x_m=0.21", fmt::format("gravity.slope_deg={:g}", slope)});
    const FlowFigures& f = observers_->find<Flow>()->now();
    const double g = 9.81, s = std::sin(slope * M_PI / 180), c = std::cos(slope * M_PI / 180);
    const double rate = 1000 * 0.5 * 0.16 * 0.3, kinetic = rate * 0.125, potential = rate * g * (-0.1 * s + 0.1 * c);
    const double bearable = 0.01 * rate * g * 0.1;
    EXPECT_NEAR(f.outflow_kinetic_power, kinetic, 0.01 * kinetic) << slope;
    EXPECT_NEAR(f.outflow_power - f.outflow_kinetic_power, potential, bearable) << slope;
    EXPECT_NEAR(run_->column("section_power_W").back(), kinetic + potential, bearable) << slope;
  }
}

/// One layer of cells is in the section, also where it runs along their faces.
TEST_F(OutflowOfHeap, OneLayerOfCellsIsInTheSection) {
  for (const double section : {0.16, 0.18, 0.2, 0.22, 0.24, 0.26}) {
    first_row({fmt::format("measure.section_x_m={:g}", section)});
    EXPECT_NEAR(observers_->find<Flow>()->now().outflow_rate, 1000 * 0.5 * 0.16 * 0.3, 0.02 * 24) << section;
  }
}

TEST_F(OutflowOfHeap, TheLastCellsAreInASectionAtTheEndOfTheDomain) {
  first_row({"domain.upper_m=[0.4, 0.16, 0.5]", "measure.section_x_m=0.3"});
  EXPECT_NEAR(observers_->find<Flow>()->now().outflow_rate, 1000 * 0.5 * 0.16 * 0.3, 0.02 * 24);
}

/// What leaves the domain has passed, whatever the rates say: never more than there was.
TEST_F(OutflowOfHeap, WhatIsGoneHasPassed) {
  first_row({"measure.section_x_m=0.2", "domain.open_faces=[\"x+\", \"z+\"]"});
  const double beyond = observers_->find<Flow>()->now().beyond_outflow;
  Metrics metrics;
  while (simulation_->time() < 1.2) metrics = take_row(5);
  const double left = simulation_->fluid()->transfers().left, still = observers_->find<Flow>()->now().beyond_outflow;
  EXPECT_GT(left, 5);
  EXPECT_NEAR(metrics.at("liquid_passed_kg"), left + still - beyond, 1e-9);
}

/// Liquid that goes over the side, and none of it through the section: how fast it was is not known, and not 0.
TEST_F(OutflowOfHeap, OfWhatLeavesElsewhereTheEnergyIsNotKnown) {
  Metrics metrics = first_row(
      {"measure.section_x_m=0.85", "domain.open_faces=[\"y+\", \"z+\"]", "fluid.region[0].velocity_m_s=[0, 0.5, 0]"});
  EXPECT_EQ(metrics.at("liquid_passed_kg"), 0);
  EXPECT_EQ(metrics.at("e_out_liquid_kinetic_kJ"), 0);  // of nothing
  metrics = take_row(20);
  EXPECT_GT(metrics.at("liquid_passed_kg"), 0.1);
  EXPECT_FALSE(metrics.contains("e_out_liquid_kinetic_kJ"));
  EXPECT_FALSE(metrics.contains("e_out_liquid_potential_kJ"));
}

}  // namespace
}  // namespace lahar::cases
