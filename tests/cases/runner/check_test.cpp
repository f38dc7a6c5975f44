#include "cases/runner/check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/assembly/estimates.h"
#include "cases/assembly/memory.h"
#include "coupling/coupling_options.h"
#include "tests/cases/runner/warns.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::load;

class SceneOfACase : public testing::TestWithParam<std::string> {};

TEST_P(SceneOfACase, PassesItsChecks) {
  EXPECT_EQ(scene::mistakes_in(case_file(GetParam())), std::vector<std::string>{});
  EXPECT_GT(check_scene(load(case_file(GetParam()))).run_time, 0);
}

INSTANTIATE_TEST_SUITE_P(Check, SceneOfACase, testing::ValuesIn(scene::scene_files()), scene::name_of_test);

/// A ball of liquid is less than the box around it; 6 l that flow in over the first half of the run are there for half
/// of it, and for a half on the mean before.
TEST(Check, CountsLiquidByItsShapeAndWhatFlowsIn) {
  const scene::Scene ball =
      load(case_file("dam_break/scene.toml"),
           {"fluid.region=[{shape = \"sphere\", centre_m = [0.3, 0.15, 0.4], radius_m = 0.1}]", "run.duration_s=2",
            "fluid.inflow=[{name = \"in\", lower_m = [0, 0, 0], upper_m = [0.1, 0.3, 0.1], velocity_m_s = [1, 0, 0], "
            "discharge_m3_s = [[0, 6e-3], [1, 6e-3]]}]"});
  const FluidFigures f = check_scene(ball).fluid.value();
  const double cell = 0.02 * 0.02 * 0.02, sphere = 4.0 / 3 * M_PI * 1e-3;
  EXPECT_NEAR(f.liquid_cells, sphere / cell, 0.02 * sphere / cell);
  EXPECT_NEAR(f.inflow_cells, 6e-3 / cell, 1e-6);
  EXPECT_NEAR(f.depth, 0.2, 2e-3);
  EXPECT_NEAR(f.mean_cells - f.liquid_cells, 0.75 * 6e-3 / cell, 1e-3 * 6e-3 / cell);
}

/// A run begins at t = 0: what a hydrograph brings before that does not come.
TEST(Check, HydrographsThatBeginBeforeTheRun) {
  const auto figures = [](const std::string& discharge) {
    return check_scene(load(case_file("dam_break/scene.toml"),
                            {"run.duration_s=2",
                             "fluid.inflow=[{name = \"in\", lower_m = [0.7, 0, 0], upper_m = [0.8, 0.3, 0.1], "
                             "velocity_m_s = [1, 0, 0], discharge_m3_s = " +
                                 discharge + "}]"}))
        .fluid.value();
  };
  const double cell = 0.02 * 0.02 * 0.02;
  EXPECT_NEAR(figures("[[-1, 6e-3], [1, 6e-3]]").inflow_cells, 6e-3 / cell, 1e-6);
  EXPECT_EQ(figures("[[-10, 1e-3], [-5, 1e-3]]").inflow_cells, 0);
  // Its peak, too: from 1 m^3/s at -1 s in straight lines to nothing at 1 s.
  const double step = figures("[[0, 0.1], [1, 0]]").time_step;
  EXPECT_NEAR(figures("[[-1, 0.2], [1, 0]]").time_step, step, 1e-9 * step);
  EXPECT_NEAR(figures("[[-1, 9], [0, 0.1], [1, 0]]").time_step, step, 1e-9 * step);
}

/// Liquid counts once, and none counts in walls: neither cells nor memory.
TEST(Check, CountsLiquidOnceAndOutsideWalls) {
  const auto figures = [](const std::vector<std::string>& set) {
    return check_scene(load(case_file("dam_break/scene.toml"), set)).fluid.value();
  };
  const std::string box = "{lower_m = [0, 0, 0], upper_m = [0.64, 0.3, 0.48]}";
  const FluidFigures once = figures({"fluid.region=[" + box + "]"});
  const FluidFigures thrice = figures({"fluid.region=[" + box + ", " + box + ", " + box + "]"});
  EXPECT_EQ(thrice.liquid_cells, once.liquid_cells);
  EXPECT_EQ(thrice.start_blocks, once.start_blocks);
  EXPECT_TRUE(warns(check_scene(load(case_file("dam_break/scene.toml"), {"fluid.region=[" + box + ", " + box + "]"})),
                    "fluid.region[1] lies in walls, or in regions before it"));
  const FluidFigures over_ground = figures({"fluid.region=[" + box + "]", "wall[2].name=ground", "wall[2].shape=plane",
                                            "wall[2].point_m=[0, 0, 0.36]", "wall[2].normal=[0, 0, 1]"});
  EXPECT_NEAR(over_ground.liquid_cells, once.liquid_cells / 4, 1e-6 * once.liquid_cells);
  EXPECT_LT(over_ground.start_blocks, 0.6 * once.start_blocks);
  EXPECT_NEAR(over_ground.depth, 0.12, 1e-6);
}

/// A lake over ground whose box goes down to the bottom of the domain: 1e7 cells of 5e8.
TEST(Check, ALakeOverHighGround) {
  const scene::Scene lake = scene::load_text(R"([scene]
name = "lake"
[run]
duration_s = 0.1
[domain]
lower_m = [0, 0, 0]
upper_m = [100, 100, 52]
[fluid]
enabled = true
cell_size_m = 0.1
[[fluid.region]]
lower_m = [0, 0, 0]
upper_m = [100, 100, 50]
[[wall]]
name = "ground"
shape = "plane"
point_m = [0, 0, 49]
normal = [0, 0, 1]
)");
  const CheckReport report = check_scene(lake);
  EXPECT_NEAR(report.fluid->liquid_cells, 1e7, 0.03e7);
  EXPECT_FALSE(warns(report, "nothing of it is left"));
}

TEST(Check, FiguresOfTheDamBreak) {
  const scene::Scene dam = load(case_file("dam_break/scene.toml"));
  const CheckReport report = check_scene(dam);
  ASSERT_TRUE(report.fluid.has_value());
  EXPECT_FALSE(report.solids.has_value());
  const FluidFigures& f = *report.fluid;
  EXPECT_EQ(f.domain_cells, 80 * 15 * 40);
  EXPECT_NEAR(f.liquid_cells, 15 * 15 * 30, 1e-6);
  EXPECT_EQ(f.start_blocks, 3 * 3 * 4);
  EXPECT_NEAR(f.mach, std::sqrt(3.0) * 0.1, 1e-12);
  EXPECT_NEAR(f.compressibility_error, 0.03, 1e-12);
  EXPECT_NEAR(f.lattice_viscosity, 1e-6 * f.time_step / (0.02 * 0.02), 1e-18);
  EXPECT_NEAR(f.tau, 0.5 + 3 * f.lattice_viscosity, 1e-15);
  EXPECT_NEAR(f.reynolds, std::sqrt(2 * 9.81 * 0.6) * 0.6 / 1e-6, 1e-3);
  EXPECT_NEAR(f.froude, std::sqrt(2.0), 1e-12);  // sqrt(2 g h) / sqrt(g h)
  EXPECT_NEAR(f.bond, 1000 * 9.81 * 0.36 / 0.0728, 1e-6);
  EXPECT_EQ(f.steps, std::ceil(0.6 / f.time_step));
  EXPECT_TRUE(report.warnings.empty()) << testing::PrintToString(report.warnings);
}

TEST(Check, FiguresOfTheDebrisFlow) {
  const CheckReport report = check_scene(scene::debris_flow());
  ASSERT_TRUE(report.fluid && report.solids);
  EXPECT_NEAR(report.solids->time_step * static_cast<double>(report.solids->substeps), report.fluid->time_step, 1e-15);
  EXPECT_NEAR(*report.solids->cells_per_smallest_grain, 4, 1e-12);
  EXPECT_NEAR(*report.solids->cells_per_wire, 0.61, 1e-12);
  EXPECT_NEAR(*report.solids->cell_reynolds, *settling_speed(scene::debris_flow()) * 0.01 / 1e-6, 1e-6);
  EXPECT_GT(report.run_time, 0);
}

/// The radius at which the fluid comes to rest is that for creeping flow by default; water among boulders is none.
TEST(Check, NamesARadiusShiftForAnotherFlow) {
  constexpr auto key = "radius_shift_cells";
  scene::Scene debris = scene::debris_flow();
  EXPECT_FALSE(warns(check_scene(debris), key));
  debris.coupling.radius_shift_cells = coupling::kRadiusShift;
  EXPECT_TRUE(warns(check_scene(debris), key));
  debris.fluid.kinematic_viscosity = 10;
  EXPECT_FALSE(warns(check_scene(debris), key));
}

/// A packing that water carries along asks for the drag that does not grow with the speed through the cells.
TEST(Check, NamesTheWeightingForGrainsThatAreCarriedAlong) {
  constexpr auto key = "coupling.body_weighting is";
  scene::Scene debris = scene::debris_flow();
  EXPECT_FALSE(warns(check_scene(debris), key));
  debris.coupling.body_weighting = scene::BodyWeighting::wall_distance;
  EXPECT_TRUE(warns(check_scene(debris), key));
  scene::Scene creeping = debris;
  creeping.fluid.kinematic_viscosity = 10;
  EXPECT_FALSE(warns(check_scene(creeping), key));
  debris.coupling.grains = scene::GrainFluid::averaged;
  EXPECT_FALSE(warns(check_scene(debris), key));
}

/// Grains of few cells win energy from liquid at rest, the denser they are the less.
TEST(Check, RestlessGrainsAreTold) {
  scene::Scene debris = scene::debris_flow();
  ASSERT_EQ(debris.coupling.body_weighting, scene::BodyWeighting::inertial);
  const auto tells = [&](double cells, double density, scene::BodyWeighting weighting) {
    debris.fluid.cell_size = smallest_grain(debris) / cells;
    debris.coupling.body_weighting = weighting;
    for (scene::Packing& packing : debris.grains.packings)
      for (scene::GrainSize& size : packing.sizes) size.density = density * debris.fluid.density;
    return warns(check_scene(debris), "may win energy");
  };
  using enum scene::BodyWeighting;
  for (const auto weighting : {wall_distance, inertial}) {
    EXPECT_TRUE(tells(2.9, 1.0, weighting));
    EXPECT_FALSE(tells(3.1, 1.0, weighting));
    EXPECT_TRUE(tells(2.4, 1.5, weighting));
    EXPECT_FALSE(tells(2.6, 1.5, weighting));
    EXPECT_TRUE(tells(1.4, 2.5, weighting));
    EXPECT_FALSE(tells(1.6, 2.5, weighting));
  }
  EXPECT_FALSE(tells(1.4, 1.0, solid_fraction));
  debris.coupling.grains = scene::GrainFluid::averaged;
  EXPECT_FALSE(tells(1.4, 1.0, wall_distance));
}

/// Grains that are averaged have no size in cells; what counts is the length over which they are.
TEST(Check, AveragedGrainsAreJudgedByTheirLength) {
  scene::Scene debris = scene::debris_flow();
  debris.fluid.cell_size = 0.02;
  debris.coupling.radius_shift_cells = coupling::kRadiusShift;
  debris.coupling.averaging_length = 0.2;
  EXPECT_TRUE(warns(check_scene(debris), "cells across"));
  EXPECT_TRUE(warns(check_scene(debris), "radius_shift_cells"));
  EXPECT_EQ(report_text(debris, check_scene(debris)).find("averaging length"), std::string::npos);

  debris.coupling.grains = scene::GrainFluid::averaged;
  const CheckReport report = check_scene(debris);
  EXPECT_FALSE(warns(report, "cells across"));
  EXPECT_FALSE(warns(report, "radius_shift_cells"));
  EXPECT_FALSE(warns(report, "averaging_length_m"));
  EXPECT_DOUBLE_EQ(*report.solids->averaging_cells, 10);
  EXPECT_DOUBLE_EQ(*report.solids->averaging_diameters, 0.2 / largest_grain(debris));
  EXPECT_NEAR((*report.solids->averaging_lengths - Vec3(0.2, 0.2, 1.5 / 7)).norm(), 0, 1e-12);
  EXPECT_NE(report_text(debris, report).find("by axis 0.2, 0.2, 0.214 m"), std::string::npos);

  debris.coupling.averaging_length = 1.5 * largest_grain(debris);
  EXPECT_TRUE(warns(check_scene(debris), "coupling.averaging_length_m is 1.5 diameters"));
}

/// 1.8 m has room for three lengths of 0.5 m: each becomes 0.6 m. A domain that is shorter than a length has one.
TEST(Check, SaysWhatTheAveragingLengthBecomes) {
  scene::Scene debris = scene::debris_flow();
  debris.fluid.cell_size = 0.02;
  debris.coupling.grains = scene::GrainFluid::averaged;
  debris.coupling.averaging_length = 0.5;
  EXPECT_TRUE(warns(check_scene(debris), "along y the domain is divided into lengths of 0.6 m"));
  debris.coupling.averaging_length = 0.6;
  EXPECT_FALSE(warns(check_scene(debris), "along y the domain is divided into lengths"));
  debris.coupling.averaging_length = 2;
  EXPECT_TRUE(warns(check_scene(debris), "is 2, more than the domain along y: 1.8 m is taken"));
  debris.coupling.averaging_length = 6;
  const CheckReport report = check_scene(debris);
  EXPECT_FALSE(warns(report, "is divided into lengths"));
  EXPECT_NEAR(report.solids->averaging_lengths->y(), 1.8, 1e-12);
}

/// A boulder that falls 1.8 m into 5 cm of water runs ten times as fast as the water falls, by which the step is
/// chosen.
TEST(Check, GrainsFasterThanTheTimeStepBearsAreTold) {
  const std::string text = scene::small_scene + R"([fluid]
enabled = true
cell_size_m = 0.02
[[fluid.region]]
lower_m = [0, 0, 0]
upper_m = [1, 1, 0.05]
[coupling]
enabled = true
)";
  const std::string key = "cells in a time step";
  const std::vector<std::string> high{"domain.upper_m=[1, 1, 2]", "grains.sphere[0].position_m=[0.5, 0.5, 1.8]"};
  EXPECT_TRUE(warns(check_scene(scene::load_text(text, high)), key));
  std::vector<std::string> bearable = high;
  bearable.push_back("fluid.max_speed_m_s=6");
  EXPECT_FALSE(warns(check_scene(scene::load_text(text, bearable)), key));
  EXPECT_FALSE(warns(check_scene(scene::load_text(text, {"grains.sphere[0].position_m=[0.5, 0.5, 0.06]"})), key));
}

/// Nodes of the averaged coupling stand in the whole domain, wet or not.
TEST(Check, CountsTheNodesOfAverages) {
  const auto averaged = [](const char* length) {
    return check_scene(load(case_file("compare_cfd_dem/as_printed.toml"),
                            {"coupling.grains=averaged", std::string("coupling.averaging_length_m=") + length}));
  };
  const CheckReport coarse = averaged("0.16"), fine = averaged("0.08");
  const Vec3 lengths = coarse.solids->averaging_lengths->cwiseInverse(),
             halves = fine.solids->averaging_lengths->cwiseInverse();
  const scene::Scene s = load(case_file("compare_cfd_dem/as_printed.toml"));
  const double more = (halves.prod() - lengths.prod()) * (s.domain.upper - s.domain.lower).prod();
  EXPECT_NEAR((fine.fluid->start_bytes - coarse.fluid->start_bytes) / (more * scene::kBytesPerNode), 1, 0.05);
  EXPECT_NEAR((fine.checkpoint_bytes - coarse.checkpoint_bytes) / (more * scene::kStoredBytesPerNode), 1, 0.05);
}

/// Twice the fields, as many lists and links.
TEST(Check, DoubleTakesMoreMemory) {
  const auto bytes = [](const char* precision) {
    return check_scene(load(case_file("dam_break/scene.toml"), {std::string("run.precision=") + precision}))
        .fluid->start_bytes;
  };
  EXPECT_NEAR(bytes("double") / bytes("float"), 1.8, 0.1);
}

}  // namespace
}  // namespace lahar::cases
