// Flow laws, wall placement, wall model and inflow in a scene: what is refused, what arrives at the solver, what check
// says.
#include <gtest/gtest.h>

#include "cases/assembly/build.h"
#include "cases/runner/check.h"
#include "cases/scene/writer.h"
#include "tests/cases/assembly/rejections.h"

namespace lahar::scene {
namespace {

const std::string kDam = "dam_break/scene.toml";
std::string inflow(const std::string& upper, const std::string& discharge) {
  return "fluid.inflow=[{name='river', lower_m=[0, 0, 0], upper_m=" + upper +
         ", velocity_m_s=[1, 0, 0], discharge_m3_s=" + discharge + "}]";
}

class FluidMistake : public testing::TestWithParam<Rejection> {};

TEST_P(FluidMistake, IsTheOneMistake) { expect_rejection(case_file(kDam), GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    CrossChecks, FluidMistake,
    testing::Values(
        Rejection{{"fluid.wall_placement=middle"}, "fluid.wall_placement", "one of \"half_way\""},
        Rejection{{"wall[0].roughness_m=-1"}, "wall[0].roughness_m", "at least 0"},
        Rejection{{"wall[0].roughness_m=0.01"}, "wall[0].roughness_m", "slip = \"wall_model\""},
        Rejection{{"fluid.rheology.law=honey"}, "fluid.rheology.law", "one of \"newtonian\""},
        Rejection{{"fluid.rheology.yield_stress_Pa=-1"}, "fluid.rheology.yield_stress_Pa", "at least 0"},
        Rejection{{"fluid.rheology.consistency_Pa_s_n=-1"}, "fluid.rheology.consistency_Pa_s_n", "at least 0"},
        Rejection{{"fluid.rheology.exponent=0.1"}, "fluid.rheology.exponent", "from 0.3 to 2"},
        Rejection{{"fluid.rheology.limit_viscosity_m2_s=-1"}, "fluid.rheology.limit_viscosity_m2_s", "at least 0"},
        Rejection{{"fluid.rheology.yield_stress_Pa=1"}, "fluid.rheology.law", "expected another law"},
        Rejection{{"fluid.rheology.exponent=0.5"}, "fluid.rheology.law", "expected another law"},
        Rejection{{"fluid.rheology.limit_viscosity_m2_s=1"}, "fluid.rheology.law", "expected another law"},
        Rejection{{"fluid.rheology.law=bingham"}, "fluid.rheology.limit_viscosity_m2_s", "above that of flow"},
        Rejection{
            {"fluid.rheology.law=bingham", "fluid.rheology.limit_viscosity_m2_s=1", "fluid.rheology.exponent=0.5"},
            "fluid.rheology.law",
            "expected \"herschel_bulkley\""},
        Rejection{{"fluid.rheology.law=herschel_bulkley", "fluid.rheology.consistency_Pa_s_n=10",
                   "fluid.rheology.limit_viscosity_m2_s=0.001"},
                  "fluid.rheology.limit_viscosity_m2_s",
                  "above that of flow"},
        Rejection{{"fluid.rheology.law=herschel_bulkley", "fluid.rheology.limit_viscosity_m2_s=1"},
                  "fluid.rheology.consistency_Pa_s_n",
                  "is 0"},
        Rejection{{"fluid.rheology.law=bingham", "fluid.rheology.limit_viscosity_m2_s=1", "fluid.smagorinsky=0.1"},
                  "fluid.rheology.law",
                  "smagorinsky"},
        Rejection{{"fluid.rheology.law=bingham", "fluid.rheology.limit_viscosity_m2_s=1", "fluid.collision=bgk"},
                  "fluid.rheology.law",
                  "bgk"},
        Rejection{{"fluid.rheology.law=bingham", "fluid.rheology.limit_viscosity_m2_s=1", "wall[0].slip=wall_model"},
                  "fluid.rheology.law",
                  "wall_model"},
        Rejection{{inflow("[0.2, 0.3, 0.2]", "[[0, 1]]")}, "fluid.inflow[0].discharge_m3_s", "has 1 entries"},
        Rejection{{inflow("[0.2, 0.3, 0.2]", "[[0, 1], [1]]")}, "fluid.inflow[0].discharge_m3_s", "has entry 2"},
        Rejection{{inflow("[0.2, 0.3, 0.2]", "[[0, 1], [1, -1]]")}, "fluid.inflow[0].discharge_m3_s", "at least 0"},
        Rejection{{inflow("[0.2, 0.3, 0.2]", "[[0, 1], [0, 1]]")}, "fluid.inflow[0].discharge_m3_s", "rising"},
        Rejection{{inflow("[0.2, 0.3, 0.01]", "[[0, 1], [1, 1]]")}, "fluid.inflow[0].upper_m", "thinner than a cell"},
        Rejection{{inflow("[0.2, 0.3, 0.2]", "[[0, 30], [1, 30]]"), "fluid.max_speed_m_s=3.5"},
                  "fluid.inflow[0].discharge_m3_s",
                  "4.2 m^3/s that its box takes (1500 cells outside walls)"},
        // Refused before its cells are counted.
        Rejection{{inflow("[0.2, 0.3, 0.2]", "[[0, 1], [1, 1]]"), "fluid.cell_size_m=1e-7"},
                  "fluid.cell_size_m",
                  "cells along the domain"},
        Rejection{{inflow("[0.2, 0.3, 9.0]", "[[0, 1], [1, 1]]")}, "fluid.inflow[0].upper_m", "outside the domain"},
        Rejection{{inflow("[0.2, 0.0, 0.2]", "[[0, 1], [1, 1]]")}, "fluid.inflow[0].upper_m", "is not above"}));

/// Of 10 x 15 x 10 cells a block leaves the upper two layers.
TEST(FluidOptions, AnInflowNeedsCellsOutsideWalls) {
  const std::string river = inflow("[0.2, 0.3, 0.2]", "[[0, 2], [1, 2]]"), speed = "fluid.max_speed_m_s=3.5";
  EXPECT_TRUE(mistakes_in(case_file(kDam), {river, speed}).empty());
  expect_rejection(case_file(kDam), {{river, speed, "wall[2].name=block", "wall[2].shape=box",
                                      "wall[2].lower_m=[-0.1, -0.1, -0.1]", "wall[2].upper_m=[0.2, 0.4, 0.16]"},
                                     "fluid.inflow[0].discharge_m3_s",
                                     "0.84 m^3/s that its box takes (300 cells outside walls)"});
}

/// One that begins when a gate has gone has its place.
TEST(FluidOptions, AnInflowMayBeginWhereAGateStood) {
  const auto mistakes = [](const std::string& opens_at, const std::string& discharge) {
    return mistakes_in(case_file(kDam), {inflow("[0.2, 0.3, 0.2]", discharge), "fluid.max_speed_m_s=3.5",
                                         "wall[2].name=gate", "wall[2].shape=box", "wall[2].lower_m=[-0.1, -0.1, -0.1]",
                                         "wall[2].upper_m=[0.2, 0.4, 0.16]", "wall[2].opens_at_s=" + opens_at});
  };
  for (const char* discharge : {"[[0, 0], [0.2, 0], [0.3, 2]]", "[[0.2, 2], [1, 2]]"}) {
    EXPECT_TRUE(mistakes("0.2", discharge).empty()) << discharge;
    EXPECT_EQ(mistakes("0.21", discharge).size(), 1U) << discharge;
  }
}

TEST(FluidOptions, ReachTheSolverAndTheResolvedScene) {
  const Scene scene =
      load(case_file(kDam), {"fluid.rheology.law=herschel_bulkley", "fluid.rheology.yield_stress_Pa=20",
                             "fluid.rheology.consistency_Pa_s_n=5", "fluid.rheology.exponent=0.5",
                             "fluid.rheology.limit_viscosity_m2_s=2", "fluid.wall_placement=interpolated",
                             "fluid.region=[]", inflow("[0.2, 0.3, 0.2]", "[[0, 0.5], [2, 0.25]]")});
  const lbm::FluidOptions o = cases::fluid_options(scene);
  EXPECT_EQ(o.rheology.law, lbm::FlowLaw::herschel_bulkley);
  EXPECT_EQ(o.rheology.yield_stress, 20);
  EXPECT_EQ(o.rheology.consistency, 5);
  EXPECT_EQ(o.rheology.exponent, 0.5);
  EXPECT_EQ(o.rheology.limit_viscosity, 2);
  EXPECT_EQ(o.domain.placement, lbm::WallPlacement::interpolated);
  ASSERT_EQ(o.inflows.size(), 1u);
  EXPECT_EQ(o.inflows[0].velocity, Vec3(1, 0, 0));
  EXPECT_NEAR(o.inflows[0].discharge.volume_until(9), 0.75, 1e-12);
  const std::string text = to_toml(scene);
  EXPECT_NE(text.find("discharge_m3_s = [[0.0, 0.5], [2.0, 0.25]]"), std::string::npos) << text;
  EXPECT_NE(text.find("law = \"herschel_bulkley\""), std::string::npos);
}

/// Defaults of the library and of scenes are the same.
TEST(FluidOptions, DefaultsOfBodiesAreThoseOfTheLibrary) {
  const Scene scene = load(case_file(kDam), {});
  const lbm::FluidOptions o = cases::fluid_options(scene), library;
  EXPECT_EQ(o.weighting, library.weighting);
  EXPECT_EQ(o.solid_operator, library.solid_operator);
  EXPECT_EQ(scene.coupling.radius_shift_cells, coupling::ResolvedGrains{}.radius_shift);
}

TEST(FluidOptions, RoughnessReachesTheWall) {
  const Scene scene = load(case_file(kDam), {"wall[0].slip=wall_model", "wall[0].roughness_m=0.002"});
  const auto walls = cases::fluid_options(scene).domain.walls.all();
  EXPECT_EQ(walls[0].slip, WallSlip::wall_model);
  EXPECT_EQ(walls[0].roughness, 0.002);
}

TEST(FluidOptions, CheckTellsBinghamAndHedstrom) {
  const Scene scene =
      load(case_file(kDam), {"fluid.rheology.law=bingham", "fluid.rheology.yield_stress_Pa=30",
                             "fluid.kinematic_viscosity_m2_s=1e-3", "fluid.rheology.limit_viscosity_m2_s=1"});
  const auto report = cases::check_scene(scene);
  const double rate = report.fluid->max_speed / 0.6;
  EXPECT_NEAR(report.fluid->bingham, 30 / (1.0 * rate), 1e-9);                // mu = 1 Pa s
  EXPECT_NEAR(report.fluid->hedstrom, 1000 * 30 * 0.36 / (1.0 * 1.0), 1e-6);  // rho yield h^2 / mu^2
  EXPECT_NE(cases::report_text(scene, report).find("Bingham, Hedstrom"), std::string::npos);
}

}  // namespace
}  // namespace lahar::scene
