#include "cases/assembly/estimates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>

#include "cases/assembly/net_spec.h"
#include "dem/time_step.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::load;

TEST(Estimates, SpeedOfAFreeFall) {
  // From the top of the column, 0.6 m above the floor of the domain.
  EXPECT_NEAR(expected_max_speed(load(case_file("dam_break/scene.toml"))), std::sqrt(2 * 9.81 * 0.6), 1e-12);
  EXPECT_EQ(expected_max_speed(load(case_file("dam_break/scene.toml"), {"fluid.max_speed_m_s=2"})), 2);
  const scene::Scene film = load(case_file("dam_break/scene.toml"), {"fluid.region[0].upper_m=[0.3, 0.3, 1e-4]"});
  EXPECT_NEAR(expected_max_speed(film), std::sqrt(2 * 9.81 * film.fluid.cell_size), 1e-12) << "less than a cell deep";
  EXPECT_NEAR(expected_max_speed(load(case_file("dam_break/scene.toml"), {"fluid.region[0].velocity_m_s=[3, 0, 4]"})),
              std::sqrt(25 + 2 * 9.81 * 0.6), 1e-12);
}

/// A box of 0.1 x 0.3 x 0.2 m at the floor: what it brings in a second has to leave through its face.
TEST(Estimates, AnInflowIsAsFastAsItsDischarge) {
  const auto speed = [](const std::string& velocity, const std::string& peak) {
    const scene::Scene dam = load(case_file("dam_break/scene.toml"),
                                  {"gravity.magnitude_m_s2=0",
                                   "fluid.inflow=[{name = \"in\", lower_m = [0.8, 0, 0], upper_m = [0.9, 0.3, 0.2], "
                                   "velocity_m_s = " +
                                       velocity + ", discharge_m3_s = [[0, 0], [0.2, " + peak + "], [0.4, 0]]}]"});
    return expected_max_speed(dam);
  };
  EXPECT_NEAR(speed("[2, 0, 0]", "0.06"), 2, 1e-12);
  EXPECT_NEAR(speed("[2, 0, 0]", "0.18"), 3, 1e-12);
  EXPECT_NEAR(speed("[0, 0, -2]", "0.18"), 6, 1e-12);
  EXPECT_NEAR(speed("[3, 0, 4]", "0.6"), 0.6 / (0.6 * 0.06 + 0.8 * 0.03), 1e-12);
  EXPECT_NEAR(speed("[0, 0, 0]", "0.18"), 3, 1e-12);
}

TEST(Estimates, SpeedDownASlope) {
  const double angle = 35 * std::numbers::pi / 180;
  const double drop = 5.6 * std::sin(angle) + 0.75 * std::cos(angle);
  scene::Scene debris = scene::debris_flow();
  EXPECT_EQ(expected_max_speed(debris), 7) << "as the scene says";
  debris.fluid.max_speed = 0;
  EXPECT_NEAR(expected_max_speed(debris), std::sqrt(2 * 9.81 * drop), 1e-12);
  EXPECT_NEAR(fluid_time_step(debris), 0.1 * 0.01 / expected_max_speed(debris), 1e-18);
}

/// The dam is 0.6 m deep: g h / c_s^2 = 3 g h (lattice velocity / max speed)^2.
TEST(Estimates, CompressionAtTheStart) {
  const scene::Scene dam = load(case_file("dam_break/scene.toml"), {"fluid.max_speed_m_s=1"});
  const double a = 3 * 9.81 * 0.6 * 0.01;
  EXPECT_NEAR(sound_speed(dam), 10 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(start_compression(dam), std::expm1(a) / a - 1, 1e-12);
  scene::Scene stacked = dam;  // the same column in two boxes
  stacked.fluid.regions.push_back(dam.fluid.regions[0]);
  stacked.fluid.regions[0].upper.z() = stacked.fluid.regions[1].lower.z() = 0.2;
  EXPECT_EQ(start_compression(stacked), start_compression(dam));
  scene::Scene weightless = dam;
  weightless.gravity.magnitude = 0;
  EXPECT_EQ(start_compression(weightless), 0);
}

/// Liquid that walls do not bear falls freely: above the floor, or where z is periodic.
TEST(Estimates, NoCompressionInFreeFall) {
  const scene::Scene dam = load(case_file("dam_break/scene.toml"), {"fluid.max_speed_m_s=1"});
  scene::Scene raised = dam;
  raised.fluid.regions[0].lower.z() = 0.1;
  EXPECT_EQ(start_compression(raised), 0);
  raised.fluid.regions.push_back(dam.fluid.regions[0]);
  raised.fluid.regions[1].upper.z() = 0.1;  // a box under it
  EXPECT_EQ(start_compression(raised), start_compression(dam));
  scene::Scene endless = dam;
  endless.domain.open_faces.clear();
  endless.domain.periodic_axes = {scene::Axis::z};
  EXPECT_EQ(start_compression(endless), 0);
}

TEST(Estimates, CountsOfThePaper) {
  const scene::Scene debris = scene::debris_flow();
  EXPECT_EQ(net_columns(debris.barrier.net), 30);
  EXPECT_EQ(net_rows(debris.barrier.net), 16);
  EXPECT_EQ(barrier_beads(debris), 480 * 36 + 905);  // cables: 5.52 m of 6.1 mm beads
  EXPECT_EQ(grain_count(debris), 3260 + 1481);
  EXPECT_EQ(smallest_grain(debris), 0.04);
}

TEST(Estimates, LimitsOfThePaper) {
  // Rayleigh times 2.07e-5 s (40 mm grains) and 1.47e-5 s (beads); bonds sqrt(0.4 m / K) less the damping of 0.02.
  scene::Scene debris = scene::debris_flow();
  debris.barrier.net.bead_inertia_scale = 1;
  const SolidsLimits limits = solids_limits(debris);
  EXPECT_NEAR(limits.grain_rayleigh, 2.07e-5, 0.01e-5);
  EXPECT_NEAR(limits.bead_rayleigh, 1.47e-5, 0.01e-5);
  const double mass = 7800 * std::numbers::pi / 6 * std::pow(0.0061, 3), area = std::numbers::pi * 0.00305 * 0.00305;
  const double e = std::numbers::sqrt2 * 0.02, damping = std::sqrt(1 + e * e) - e;
  EXPECT_NEAR(limits.ring_bond, std::sqrt(0.4 * mass / (3e11 * area)) * damping, 1e-10);
  EXPECT_NEAR(limits.cable_bond, std::sqrt(0.4 * mass / (8e11 * area)) * damping, 1e-10);
}

/// With slow spins bonds are limited by translation, sqrt(m / K), and inertia lengthens all limits of beads.
TEST(Estimates, SlowBeadsLengthenTheLimits) {
  scene::Scene debris = scene::debris_flow();
  EXPECT_EQ(debris.barrier.net.bead_inertia_scale, 4);
  const SolidsLimits limits = solids_limits(debris);
  const double mass = 7800 * std::numbers::pi / 6 * std::pow(0.0061, 3), area = std::numbers::pi * 0.00305 * 0.00305;
  const double e = std::numbers::sqrt2 * 0.02, damping = std::sqrt(1 + e * e) - e;
  EXPECT_NEAR(limits.cable_bond, std::sqrt(mass / (8e11 * area)) * damping, 1e-10);
  debris.barrier.net.bead_mass_scale = 9;
  const SolidsLimits slow = solids_limits(debris);
  EXPECT_NEAR(slow.cable_bond / limits.cable_bond, 3, 1e-12);
  EXPECT_NEAR(slow.ring_bond / limits.ring_bond, 3, 1e-12);
  EXPECT_NEAR(slow.bead_rayleigh / limits.bead_rayleigh, 3, 1e-12);
  EXPECT_EQ(slow.grain_rayleigh, limits.grain_rayleigh);
}

TEST(Estimates, LinearContactsAreLimitedByTheirOwnDuration) {
  // 0.35 of half a period of the smallest grains (40 mm, 2500 kg/m3) against each other, pi sqrt(m / 2 k).
  scene::Scene debris = scene::debris_flow();
  debris.solids.contact_law = dem::LinearSpringDashpot{1e6};
  double density = 0;
  for (const auto& size : debris.grains.packings[0].sizes)
    if (size.diameter < 0.05) density = size.density;
  const double mass = density * std::numbers::pi / 6 * std::pow(0.04, 3);
  EXPECT_NEAR(solids_limits(debris).grain_rayleigh, 0.35 * std::numbers::pi * std::sqrt(0.5 * mass / 1e6), 1e-12);
}

TEST(Estimates, SofteningLengthensTheLimits) {
  const SolidsLimits hard = solids_limits(scene::debris_flow());
  scene::Scene softened = scene::debris_flow();
  softened.solids.contact_modulus_scale = 0.01;
  softened.solids.bond_stiffness_scale = 0.04;
  const SolidsLimits soft = solids_limits(softened);
  EXPECT_NEAR(soft.grain_rayleigh / hard.grain_rayleigh, 10, 1e-9);
  EXPECT_NEAR(soft.bead_rayleigh / hard.bead_rayleigh, 10, 1e-9);
  EXPECT_NEAR(soft.cable_bond / hard.cable_bond, 5, 1e-9);
}

/// A few beads of a post ask for the step that all ask for.
TEST(Estimates, PostLimitIsThatOfTheWholePost) {
  for (const char* foot : {"fixed", "hinged"})
    for (const char* height : {"0.2", "0.22", "0.23", "0.8"}) {
      const scene::Scene spans =
          load(case_file("two_spans/scene.toml"),
               {std::string("barrier.posts.foot=") + foot, std::string("barrier.posts.height_m=") + height});
      dem::Particles particles;
      dem::Bonds bonds;
      add_post(post_spec(scene::make_spans_spec(spans), 0), particles, bonds);
      const double whole = dem::bond_time_step(bonds, particles);
      EXPECT_NEAR(solids_limits(spans).post_bond, whole, 1e-9 * whole) << foot << ", " << height;
    }
}

/// Whole posts of four million beads take seconds.
TEST(Estimates, PostLimitIsTakenFromAFewBeads) {
  scene::Scene spans = load(case_file("two_spans/scene.toml"));
  spans.barrier.posts.height = 1e5;
  const std::clock_t start = std::clock();
  EXPECT_GT(solids_limits(spans).post_bond, 0);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 0.3);
}

/// Cables on posts are compared with all other wires: long ones take as long as many.
TEST(Estimates, BarriersThatCanBeTried) {
  scene::Scene spans = load(case_file("two_spans/scene.toml"));
  EXPECT_TRUE(can_be_tried(spans));
  spans.barrier.posts.height = 100;
  EXPECT_LT(barrier_beads(spans), 200'000);
  EXPECT_FALSE(can_be_tried(spans));
  spans.barrier.posts.elements = {};
  EXPECT_TRUE(can_be_tried(spans));
  spans.barrier.posts.height = 1e300;
  EXPECT_FALSE(can_be_tried(spans));
}

TEST(Estimates, SettlingSpeedFromStokesToNewton) {
  EXPECT_NEAR(settling_speed(1e-5, 2.5, 1e-6, 9.81), 1.5 * 9.81 * 1e-10 / 18e-6, 1e-7);
  EXPECT_NEAR(settling_speed(1e-5, 0.5, 1e-6, 9.81), 0.5 * 9.81 * 1e-10 / 18e-6, 1e-7);
  EXPECT_NEAR(settling_speed(0.04, 2.5, 1e-6, 9.81), std::sqrt(4.0 / 3 * 1.5 * 9.81 * 0.04 / 0.44), 1e-9);
  // ten Cate et al. 2002, case E4: Re 31.9, 0.128 m/s far from walls
  EXPECT_NEAR(settling_speed(0.015, 1120.0 / 960, 0.058 / 960, 9.81), 0.128, 0.006);
  EXPECT_EQ(settling_speed(0.04, 1, 1e-6, 9.81), 0);
}

TEST(Estimates, SettlingSpeedOfAScene) {
  const double small = settling_speed(0.04, 2.5, 1e-6, 9.81), large = settling_speed(0.08, 2.5, 1e-6, 9.81);
  const double shares[] = {3260 * 0.064, 1481 * 0.512};
  EXPECT_NEAR(*settling_speed(scene::debris_flow()), (shares[0] * small + shares[1] * large) / (shares[0] + shares[1]),
              1e-9);
  EXPECT_FALSE(settling_speed(load(case_file("dam_break/scene.toml"))));
}

TEST(Estimates, TimeStepIsTheSmallerShare) {
  scene::Scene debris = scene::debris_flow();
  const SolidsLimits limits = solids_limits(debris);
  EXPECT_DOUBLE_EQ(solids_time_step(debris), std::min(debris.solids.contact_safety * limits.bead_rayleigh,
                                                      debris.solids.bond_safety * limits.cable_bond));
  debris.solids.time_step = 5e-7;
  EXPECT_EQ(solids_time_step(debris), 5e-7);
  EXPECT_EQ(solids_time_step(load(case_file("dam_break/scene.toml"))), std::numeric_limits<double>::infinity());
}

/// As few long steps as grains allow, and no longer than they must be to be so few.
TEST(Estimates, LongStepsAreAlike) {
  struct Row {
    std::int64_t substeps;
    double grain_step;  ///< in particle steps
    std::int64_t long_step;
  };
  for (const Row& row :
       {Row{10, 0.5, 1}, Row{10, 1.9, 1}, Row{10, 2, 2}, Row{10, 3.5, 3}, Row{10, 4.9, 4}, Row{10, 7, 5},
        Row{10, 9.9, 5}, Row{10, 1000, 10}, Row{7, 5, 4}, Row{137, 5.03, 5}, Row{1, 9, 1}})
    EXPECT_EQ(long_step(row.substeps, 1e-5, row.grain_step * 1e-5), row.long_step)
        << row.substeps << ", " << row.grain_step;
}

TEST(Estimates, WholeSubstepsFit) {
  EXPECT_EQ(substeps(1e-4, 1e-5), 10);
  EXPECT_EQ(substeps(1e-4, 0.99e-5), 11);
  EXPECT_EQ(substeps(1e-4, 1), 1);
  EXPECT_EQ(substeps(0.3, 0.1), 3);  // 0.3 / 0.1 is a little less than 3, and 0.1 + 0.2 a little more
}

}  // namespace
}  // namespace lahar::cases
