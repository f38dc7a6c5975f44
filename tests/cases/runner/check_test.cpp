#include "cases/runner/check.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/assembly/estimates.h"
#include "cases/assembly/memory.h"
#include "coupling/coupling_options.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::load;

bool warns(const CheckReport& report, const std::string& part) {
  for (const std::string& w : report.warnings)
    if (w.find(part) != std::string::npos) return true;
  return false;
}

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
  EXPECT_NEAR(f.mean_cells - f.liquid_cells, 0.75 * 6e-3 / cell, 1e-3 * 6e-3 / cell);
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

/// Each picture takes about a second.
TEST(Check, CountsPictures) {
  const auto run_time = [](const std::string& interval) {
    return check_scene(
               load(case_file("dam_break/scene.toml"), {"run.duration_s=1", "run.image_interval_s=" + interval}))
        .run_time;
  };
  EXPECT_NEAR(run_time("0.025") - run_time("0"), 41 * (run_time("2") - run_time("0")), 1e-6);
  EXPECT_GT(run_time("2") - run_time("0"), 0.3);
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

TEST(Check, DoubleTakesTwiceTheMemory) {
  const double single = check_scene(load(case_file("dam_break/scene.toml"))).fluid->start_bytes;
  const double twice =
      check_scene(load(case_file("dam_break/scene.toml"), {"run.precision=double"})).fluid->start_bytes;
  EXPECT_NEAR(twice / single, 2, 0.1);
}

TEST(Check, MoreThreadsAreFaster) {
  const scene::Scene hanging = scene::debris_flow();
  EXPECT_NEAR(check_scene(hanging, 1).run_time / check_scene(hanging, 4).run_time, 4, 1e-9);
  scene::Scene as_built = hanging;
  as_built.barrier.settle_time = 0;
  EXPECT_GT(check_scene(hanging, 1).run_time, check_scene(as_built, 1).run_time);
}

/// By the contacts of grains, which then take longer steps.
TEST(Check, TwoRatesAreFaster) {
  const auto report = [](const char* two_rates) {
    return check_scene(load(case_file("compare_cfd_dem/matched.toml"),
                            {"materials.rock.youngs_modulus_Pa=3.5e9", fmt::format("solids.two_rates={}", two_rates)}));
  };
  const CheckReport one = report("false"), two = report("true");
  EXPECT_EQ(one.solids->long_step, 1);
  EXPECT_GT(two.solids->long_step, 2);
  EXPECT_LT(two.run_time, 0.9 * one.run_time);
  EXPECT_GT(two.run_time, 0.5 * one.run_time);
}

/// The net settles with its own mass: what that takes does not shrink with the steps of slow beads.
TEST(Check, HangingTakesAsLongWithSlowBeads) {
  const auto hanging = [](double mass_scale) {
    scene::Scene with = scene::debris_flow();
    with.barrier.net.bead_mass_scale = mass_scale;
    scene::Scene without = with;
    without.barrier.settle_time = 0;
    return check_scene(with).run_time - check_scene(without).run_time;
  };
  EXPECT_GT(hanging(1), 1);
  EXPECT_NEAR(hanging(10) / hanging(1), 1, 1e-6);
}

TEST(Warnings, Fluid) {
  const auto report = [](std::vector<std::string> set) {
    return check_scene(load(case_file("dam_break/scene.toml"), set));
  };
  EXPECT_TRUE(warns(report({"run.output_interval_s=1"}), "run.output_interval_s (1 s) is longer than the run"));
  EXPECT_TRUE(warns(report({"run.series_interval_s=1"}), "run.series_interval_s"));
  EXPECT_TRUE(warns(report({"run.image_interval_s=1"}), "run.image_interval_s"));
  EXPECT_TRUE(warns(report({"fluid.collision=bgk"}), "unstable"));
  EXPECT_FALSE(warns(report({"fluid.collision=bgk", "fluid.smagorinsky=0.16"}), "unstable"));
  EXPECT_TRUE(warns(report({"fluid.lattice_velocity=0.2"}), "Ma = 0.35"));
  EXPECT_TRUE(warns(report({"fluid.cell_size_m=0.2"}), "cells deep"));
  EXPECT_TRUE(warns(report({"gravity.magnitude_m_s2=981"}), "gravity.magnitude_m_s2 is 981"));
  EXPECT_FALSE(warns(report({"gravity.magnitude_m_s2=24.8"}), "gravity.magnitude_m_s2"));  // Jupiter
}

/// A box of 0.3 by 0.4 m across a stream of 1 m/s carries 0.12 m^3/s.
TEST(Warnings, ADischargeThatItsBoxDoesNotCarry) {
  const auto report = [](const std::string& discharge, const std::string& velocity) {
    return check_scene(
        load(case_file("dam_break/scene.toml"),
             {"fluid.inflow=[{name = \"pump\", lower_m = [0.4, 0, 0], upper_m = [0.8, 0.3, 0.4], "
              "velocity_m_s = [" +
              velocity + ", 0, 0], discharge_m3_s = [[0, " + discharge + "], [1, " + discharge + "]]}]"}));
  };
  EXPECT_TRUE(warns(report("0.3", "1"), "fluid.inflow \"pump\" comes with 1 m/s, but its discharge_m3_s asks for 2.5"));
  EXPECT_FALSE(warns(report("0.2", "1"), "asks for"));
  EXPECT_FALSE(warns(report("0.3", "0"), "asks for"));
  EXPECT_TRUE(warns(report("2", "0"), "asks for 12.5 m/s"));
  // 0.3 m wide: 0.05 m^3/s at 1 m/s are 0.167 m deep
  EXPECT_FALSE(warns(report("0.05", "1"), "cells deep"));
  EXPECT_TRUE(warns(report("0.015", "1"), "cells deep, with a Froude number of 1.4"));
  EXPECT_FALSE(warns(report("0.06", "4"), "cells deep"));
}

/// The dam is 0.054 m^3 in a tank of 0.384 m^3, of which a sill takes 0.024 m^3.
TEST(Warnings, ATankThatIsOverfilled) {
  const auto report = [](const std::string& discharge, std::vector<std::string> set) {
    set.insert(set.end(), {"domain.open_faces=[]", "run.duration_s=1",
                           "fluid.inflow=[{name = \"pump\", lower_m = [0.4, 0, 0], upper_m = [0.8, 0.3, 0.4], "
                           "velocity_m_s = [1, 0, 0], discharge_m3_s = [[0, " +
                               discharge + "], [1, " + discharge + "]]}]"});
    return check_scene(load(case_file("dam_break/scene.toml"), set));
  };
  const std::vector<std::string> sill{"wall[2].name=sill", "wall[2].shape=box", "wall[2].lower_m=[1.2, -1, -1]",
                                      "wall[2].upper_m=[2, 1, 0.2]"};
  EXPECT_TRUE(warns(report("0.34", {}), "fluid.inflow \"pump\": 0.34 m^3 in the time of the run and 0.054 m^3"));
  EXPECT_TRUE(warns(report("0.34", {}), "0.384 m^3 that the domain has room for"));
  EXPECT_FALSE(warns(report("0.32", {}), "has room for"));
  EXPECT_TRUE(warns(report("0.32", sill), "0.36 m^3 that the domain has room for"));
  EXPECT_FALSE(warns(report("0.3", sill), "has room for"));
}

TEST(Warnings, AMaxSpeedBelowThatOfADrop) {
  const auto report = [](const char* speed) {
    return check_scene(load(case_file("dam_break/scene.toml"), {std::string("fluid.max_speed_m_s=") + speed}));
  };
  EXPECT_TRUE(warns(report("2"), "fluid.max_speed_m_s is 2 m/s"));  // sqrt(2 g 0.6 m) = 3.43 m/s
  EXPECT_TRUE(warns(report("2"), "reaches 3.43 m/s: Ma would be 0.30"));
  EXPECT_FALSE(warns(report("3.5"), "max_speed_m_s"));
  EXPECT_FALSE(warns(report("0"), "max_speed_m_s"));
}

/// The domain is 1.6 x 0.3 m; each point of the map is the middle of a square of 0.6 m.
TEST(Warnings, GroundBeyondAHeightmap) {
  const scene::ScratchFolder scratch;
  scratch.write("ground.txt", "0.2 0.1 0.0\n0.2 0.1 0.0\n");
  const auto report = [&](const std::string& place) {
    const auto file = scratch.write(
        "scene.toml", "[scene]\nbase = \"" + case_file("dam_break/scene.toml").string() +
                          "\"\nname = \"on_ground\"\n[[wall]]\nname = \"ground\"\nshape = \"heightmap\"\n"
                          "file = \"ground.txt\"\nspacing_m = 0.6\ntranslate_m = " +
                          place + "\n[[probe]]\nname = \"depth\"\nkind = \"height\"\nposition_m = [1.0, 0.1, 0.0]\n");
    return check_scene(load(file));
  };
  EXPECT_TRUE(warns(report("[0, 0, 0]"), "wall[0] covers x from -0.3 to 1.5 m and y from -0.3 to 0.9 m"));
  EXPECT_FALSE(warns(report("[0.3, 0, 0]"), "wall[0] covers")) << "x from 0 to 1.8 m";
}

TEST(Warnings, Solids) {
  const auto report = [](auto change) {
    scene::Scene debris = scene::debris_flow();
    change(debris);
    return check_scene(debris);
  };
  using S = scene::Scene;
  EXPECT_TRUE(warns(report([](S& s) { s.solids.time_step = 1e-4; }), "above the critical time step"));
  EXPECT_FALSE(warns(report([](S& s) { s.solids.time_step = 1e-7; }), "critical"));
  const auto hanging = [](const char* step) {  // beads that do not touch
    return check_scene(load(case_file("hanging_net/scene.toml"),
                            {"barrier.net.beads_per_ring=26", "barrier.bonds.cable_stiffness_N_m3=3e11",
                             "barrier.bonds.dissipator_stiffness_N_m3=[]", "barrier.bonds.dissipator_force_limit_N=[]",
                             "solids.bond_stiffness_scale=1", std::string("solids.time_step_s=") + step}));
  };
  const char* const as_built = "above what the bonds of the barrier as built allow";
  EXPECT_TRUE(warns(hanging("6.3e-6"), as_built));
  EXPECT_FALSE(warns(hanging("4e-6"), as_built));
  EXPECT_TRUE(
      warns(report([](S& s) { s.solids.contact_modulus_scale = 0.5; }), "contacts are softened: moduli times 0.5"));
  EXPECT_TRUE(warns(report([](S& s) { s.solids.bond_stiffness_scale = 0.5; }), "bonds are softened"));
  EXPECT_TRUE(warns(report([](S& s) { s.coupling.enabled = false; }), "do not feel each other"));
  EXPECT_TRUE(warns(report([](S& s) { s.coupling.wire_drag = false; }), "water does not feel the net"));
  EXPECT_TRUE(warns(report([](S& s) { s.grains.packings[0].sizes[1].density = 190; }), "the lightest grain has 0.19"));
  EXPECT_FALSE(warns(report([](S& s) { s.grains.packings[0].sizes[1].density = 210; }), "the lightest grain"));
  EXPECT_TRUE(warns(report([](S& s) { s.coupling.body_weighting = scene::BodyWeighting::noble_torczynski; }),
                    "lets water through"));
  EXPECT_TRUE(warns(report([](S& s) { s.fluid.cell_size = 0.02; }), "2.0 cells across"));
  EXPECT_TRUE(warns(report([](S& s) { s.grains.packings[0].target_height = 0.5; }), "more than random packings"));
  EXPECT_TRUE(warns(report([](S& s) { s.contacts.erase(s.contacts.begin() + 2); }),
                    "no [[contact]] for \"rock\" and \"steel\""));
  EXPECT_FALSE(warns(report([](S&) {}), "no [[contact]]"));
  const auto rolling = [&](dem::WireContacts wires) {
    return report([&](S& s) {
      s.solids.wire_contacts = wires;
      for (scene::Contact& c : s.contacts) c.rolling_friction = 0.3;
    });
  };
  EXPECT_TRUE(warns(rolling(dem::WireContacts::capsules), "does not act on wires"));
  EXPECT_FALSE(warns(rolling(dem::WireContacts::beads), "does not act on wires"));
}

TEST(Warnings, WallsBetweenCells) {
  const auto report = [](std::vector<std::string> set) {
    return check_scene(load(case_file("dam_break/scene.toml"), set));
  };
  EXPECT_FALSE(warns(report({}), "acts on the liquid"));
  EXPECT_TRUE(warns(report({"domain.upper_m=[1.613, 0.3, 0.8]"}),
                    "domain.upper_m at x = 1.613 m acts on the liquid at 1.62 m, the nearest faces of cells"));
  EXPECT_FALSE(warns(report({"domain.upper_m=[1.613, 0.3, 0.8]", "fluid.wall_placement=interpolated"}), "acts on"));
  EXPECT_FALSE(warns(report({"domain.upper_m=[1.613, 0.3, 0.8]", "domain.open_faces=['x+']"}), "acts on"));
  // A cell whose centre lies on a wall is liquid: a bed half-way acts below, a ceiling above.
  const auto half_way = [](const char* normal) {
    return check_scene(scene::load_text(R"([scene]
name = "half_way"
[run]
duration_s = 0.1
[domain]
lower_m = [0, 0, 0]
upper_m = [1, 1, 2]
[fluid]
enabled = true
cell_size_m = 0.125
[[fluid.region]]
lower_m = [0, 0, 0.5]
upper_m = [1, 1, 0.75]
[[wall]]
name = "plate"
shape = "plane"
point_m = [0, 0, 0.8125]
normal = )" + std::string(normal)));
  };
  EXPECT_TRUE(warns(half_way("[0, 0, -1]"), "z = 0.8125 m acts on the liquid at 0.875 m"));
  EXPECT_TRUE(warns(half_way("[0, 0, 1]"), "z = 0.8125 m acts on the liquid at 0.75 m"));
}

/// Of viscosity, of places far from the origin, of a floor that ends at the domain.
TEST(Warnings, WhatIsFarOutside) {
  const auto report = [](std::vector<std::string> set) {
    return check_scene(load(case_file("dam_break/scene.toml"), set));
  };
  EXPECT_TRUE(warns(report({"fluid.kinematic_viscosity_m2_s=10"}), "what is so viscous flows too fast"));
  EXPECT_FALSE(warns(report({}), "what is so viscous"));
  const auto mud = [&](const std::string& limit) {
    return report({"fluid.rheology.law=bingham", "fluid.rheology.yield_stress_Pa=20",
                   "fluid.rheology.limit_viscosity_m2_s=" + limit, "fluid.smagorinsky=0"});
  };
  EXPECT_TRUE(warns(mud("1"), "tau - 1/2 at fluid.rheology.limit_viscosity_m2_s is"));
  EXPECT_FALSE(warns(mud("0.01"), "what is so viscous"));
  EXPECT_TRUE(warns(
      report({"domain.lower_m=[500000, 0, 0]", "domain.upper_m=[500001.6, 0.3, 0.8]",
              "fluid.region[0].lower_m=[500000, 0, 0]", "fluid.region[0].upper_m=[500000.6, 0.3, 0.6]", "probe=[]"}),
      "coordinates reach 500002 m"));
  EXPECT_FALSE(warns(report({}), "coordinates reach"));
  const auto box = [&](const char* top) {
    return report(
        {"wall=[{name='floor', shape='box', lower_m=[-1, -1, -0.2], upper_m=[3, 1, " + std::string(top) + "]}]"});
  };
  EXPECT_FALSE(warns(box("0"), "stands outside the domain"));
  EXPECT_TRUE(warns(box("-0.1"), "stands outside the domain"));
}

TEST(Warnings, SectionsAtOpenFaces) {
  const auto warned = [](const std::string& x, const std::string& normal) {
    return warns(check_scene(load(case_file("dam_break/scene.toml"),
                                  {"domain.open_faces=['x+']",
                                   "section=[{name='end', point_m=[" + x + ", 0.1, 0.1], normal=" + normal + "}]"})),
                 "cells off an open face");
  };
  const double end = load(case_file("dam_break/scene.toml")).domain.upper.x();
  EXPECT_TRUE(warned(std::to_string(end), "[1, 0, 0]"));
  EXPECT_FALSE(warned(std::to_string(end - 0.1), "[1, 0, 0]"));
  EXPECT_FALSE(warned(std::to_string(end), "[0, 0, 1]")) << "along the face";
}

/// Rows come at the first step that has reached their time; the dam's steps are 5.8e-4 s.
TEST(Warnings, RowsBetweenSteps) {
  const auto report = [](double steps, bool adaptive = false) {
    scene::Scene dam = scene::load(case_file("dam_break/scene.toml"));
    dam.run.series_interval = steps * check_scene(dam).fluid->time_step;
    dam.fluid.adaptive_time_step = adaptive;
    return check_scene(dam);
  };
  EXPECT_TRUE(warns(report(2.4), "is 2.4 time steps: rows come every 2 or 3 steps"));
  EXPECT_TRUE(warns(report(0.3), "rows come every 1 steps"));
  for (const double steps : {1.0, 2.0, 2.05, 8.4, 100.5}) EXPECT_FALSE(warns(report(steps), "rows come")) << steps;
  EXPECT_FALSE(warns(report(2.4, true), "rows come"));
}

TEST(Warnings, ThingsInWallsOrOverEachOther) {
  const auto report = [](auto change) {
    scene::Scene debris = scene::debris_flow();
    change(debris);
    return check_scene(debris);
  };
  using S = scene::Scene;
  const auto in_bed = [](S& s) { s.fluid.regions[0].lower.z() = -0.2, s.fluid.regions[0].upper.z() = -0.1; };
  EXPECT_TRUE(warns(report(in_bed), "fluid.region[0] lies in walls"));
  EXPECT_FALSE(warns(report([](S&) {}), "lies in walls"));
  const auto gauge = [](S& s) {
    scene::Probe probe;
    probe.kind = scene::ProbeKind::pressure;
    probe.position = Vec3(1, 1, -0.1);
    s.probes.push_back(probe);
  };
  EXPECT_TRUE(warns(report(gauge), "probe[0] lies in a wall"));
  EXPECT_TRUE(warns(report([](S& s) { s.grains.packings.push_back(s.grains.packings[0]); }),
                    "grains.packing[0] and grains.packing[1] share space"));
}

TEST(Warnings, GatesThatStayClosed) {
  const auto file = case_file("dam_break/scene.toml");
  const double end = load(file).run.duration;
  const auto gate = [&](double time) { return check_scene(load(file, {fmt::format("wall[1].opens_at_s={}", time)})); };
  EXPECT_TRUE(warns(gate(end), "opens at"));
  EXPECT_FALSE(warns(gate(0.5 * end), "opens at"));
  EXPECT_FALSE(warns(gate(0), "opens at"));
}

/// The liquid feels a box by the cells whose centres lie in it.
TEST(Warnings, WallsThinnerThanACell) {
  const auto file = case_file("dam_break/scene.toml");
  const auto plate = [&](double from, double to) {
    return check_scene(
        load(file, {"wall[2].shape=box", "wall[2].name=plate", fmt::format("wall[2].lower_m=[{}, -1, -1]", from),
                    fmt::format("wall[2].upper_m=[{}, 1, 0.2]", to)}));
  };
  const double dx = load(file).fluid.cell_size;
  EXPECT_TRUE(warns(plate(0.9 + 0.6 * dx, 0.9 + 0.9 * dx), "wall \"plate\" has no cell of its own"));
  EXPECT_FALSE(warns(plate(0.9 + 0.6 * dx, 0.9 + 1.6 * dx), "has no cell of its own"));
  const auto rod = [&](double radius, double z) {  // between the centres of cells where z is a whole number of them
    return check_scene(
        load(file, {"wall[2].shape=cylinder", "wall[2].name=rod", fmt::format("wall[2].radius_m={}", radius),
                    fmt::format("wall[2].start_m=[0.9, 0.1, {}]", z), fmt::format("wall[2].end_m=[0.9, 0.2, {}]", z)}));
  };
  EXPECT_TRUE(warns(rod(0.6 * dx, 10 * dx), "wall \"rod\" has no cell of its own"));
  EXPECT_FALSE(warns(rod(0.8 * dx, 10 * dx), "has no cell of its own"));
  const auto ball = [&](double radius) {
    return check_scene(load(file, {"wall[2].shape=sphere", "wall[2].name=ball", "wall[2].centre_m=[0.9, 0.1, 0.2]",
                                   fmt::format("wall[2].radius_m={}", radius)}));
  };
  EXPECT_TRUE(warns(ball(0.8 * dx), "wall \"ball\" has no cell of its own"));
  EXPECT_FALSE(warns(ball(0.9 * dx), "has no cell of its own"));
}

TEST(Warnings, GrainsWithoutWalls) {
  EXPECT_TRUE(warns(check_scene(load(case_file("bouncing_sphere/scene.toml"), {"wall=[]"})), "nothing holds them"));
  EXPECT_FALSE(warns(check_scene(load(case_file("bouncing_sphere/scene.toml"))), "nothing holds them"));
}

TEST(Warnings, FacesThatGrainsFallOutOf) {
  const auto report = [](const std::vector<std::string>& set) {
    return check_scene(load(case_file("debris_flow/scene.toml"), set));
  };
  EXPECT_FALSE(warns(report({}), "which are lost"));
  EXPECT_TRUE(
      warns(report({"wall[3]={name='other', shape='plane', point_m=[0, 0, 0], normal=[0, 0, 1], material='wall'}"}),
            "without a [[wall]]: y+"));
  EXPECT_TRUE(warns(report({"wall[3]={name='pier', shape='cylinder', start_m=[3, 1, 0], end_m=[3, 1, 1], radius_m=0.1, "
                            "material='wall'}"}),
                    "without a [[wall]]: y+"));
}

/// 50 GPa that were written as 50.
TEST(Warnings, GrainsThatSinkInUnderTheirWeight) {
  const auto report = [](const std::string& modulus) {
    return check_scene(load(case_file("debris_flow/scene.toml"), {"materials.rock.youngs_modulus_Pa=" + modulus}));
  };
  EXPECT_FALSE(warns(report("50e9"), "sink into each other"));
  EXPECT_TRUE(warns(report("50"), "of a radius under their own weight"));
}

TEST(Warnings, MudWhoseLimitHidesItsLaw) {
  const auto report = [](const std::string& limit) {
    return check_scene(load(case_file("dam_break/scene.toml"),
                            {"fluid.rheology.law=herschel_bulkley", "fluid.rheology.yield_stress_Pa=50",
                             "fluid.rheology.consistency_Pa_s_n=5", "fluid.rheology.exponent=0.5",
                             "fluid.rheology.limit_viscosity_m2_s=" + limit}));
  };
  EXPECT_TRUE(warns(report("1e-5"), "the law is not felt"));
  EXPECT_FALSE(warns(report("0.5"), "the law is not felt"));
}

TEST(Warnings, WallsBesideTheDomain) {
  const auto report = [](const std::string& lower) {
    return check_scene(
        load(case_file("debris_flow/scene.toml"), {"wall[4]={name='dam', shape='box', material='wall', lower_m=[" +
                                                   lower + ", 0, 0], upper_m=[2600, 1.8, 0.3]}"}));
  };
  EXPECT_TRUE(warns(report("2500"), "\"dam\" stands outside the domain"));
  EXPECT_FALSE(warns(report("5.2"), "stands outside"));
}

TEST(Warnings, ValuesInOtherUnits) {
  const auto report = [](const std::string& set) {
    return check_scene(load(case_file("debris_flow/scene.toml"), {set}));
  };
  EXPECT_TRUE(warns(report("contact[0].friction=30"), "it is a coefficient"));
  EXPECT_TRUE(warns(report("fluid.density_kg_m3=1.6"), "fluid.density_kg_m3 is 1.6"));
  EXPECT_TRUE(warns(report("barrier.anchors.cable_places=[]"), "no end of a cable is fixed"));
}

TEST(ReportText, NamesFiguresAndWarnings) {
  scene::Scene debris = scene::debris_flow();
  debris.solids.contact_modulus_scale = 0.1;
  const std::string text = report_text(debris, check_scene(debris));
  for (const char* part :
       {"debris_flow: ", "cells ", "memory", "time step", "tau", "Ma ", "Re, Fr, Bo", "Rayleigh time, beads",
        "bond limit, cables", "steps in a fluid step", "cells per wire", "run time", "warning: contacts"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

/// Water in cells of 20 mm: friction reaches 0.8 mm in 0.7 s. Oil of 1e-3 m^2/s is slowed over 26 mm.
TEST(ReportText, SaysHowFarTheFrictionOfWallsReaches) {
  const auto text = [](const std::vector<std::string>& changes) {
    const scene::Scene scene = load(case_file("dam_break/scene.toml"), changes);
    return report_text(scene, check_scene(scene));
  };
  constexpr auto advice = "free_slip is nearer";
  const std::vector<std::string> common{"fluid.cell_size_m=0.02", "run.duration_s=0.7"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), common.begin(), common.end());
    return text(more);
  };
  EXPECT_NE(with({"domain.slip=no_slip"}).find("0.042 cells"), std::string::npos);
  EXPECT_NE(with({"domain.slip=no_slip"}).find(advice), std::string::npos);
  EXPECT_EQ(with({"domain.slip=free_slip"}).find(advice), std::string::npos);
  EXPECT_EQ(with({"fluid.kinematic_viscosity_m2_s=1e-3"}).find(advice), std::string::npos);
}

}  // namespace
}  // namespace lahar::cases
