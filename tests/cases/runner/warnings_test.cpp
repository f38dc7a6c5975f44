// What `lahar check` and a run warn of.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "cases/assembly/build.h"
#include "tests/cases/runner/warns.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::load;

TEST(Warnings, Fluid) {
  const auto report = [](std::vector<std::string> set) {
    return check_scene(load(case_file("dam_break/scene.toml"), set));
  };
  EXPECT_TRUE(warns(report({"run.output_interval_s=1"}), "run.output_interval_s (1 s) is longer than the run"));
  EXPECT_TRUE(warns(report({"run.series_interval_s=1"}), "run.series_interval_s"));
  EXPECT_TRUE(warns(report({"run.image_interval_s=1"}), "run.image_interval_s"));
  EXPECT_TRUE(
      warns(report({"run.image_interval_s=1e-6"}), "run.image_interval_s (1e-06 s) is less than the time step"));
  EXPECT_FALSE(warns(report({"run.image_interval_s=0.01"}), "less than the time step"));
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
  const auto report = [](const char* speed, const char* adaptive = "false") {
    return check_scene(load(case_file("dam_break/scene.toml"), {std::string("fluid.max_speed_m_s=") + speed,
                                                                std::string("fluid.adaptive_time_step=") + adaptive}));
  };
  EXPECT_TRUE(warns(report("2"), "fluid.max_speed_m_s is 2 m/s"));  // sqrt(2 g 0.6 m) = 3.43 m/s
  EXPECT_TRUE(warns(report("2"), "reaches 3.43 m/s: Ma would be 0.30"));
  EXPECT_FALSE(warns(report("3.5"), "max_speed_m_s"));
  EXPECT_FALSE(warns(report("2", "true"), "Ma would be"));  // the step adapts to it
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
  const auto linear = [&](dem::WireContacts wires) {
    return report([&](S& s) {
      s.solids.wire_contacts = wires;
      s.solids.contact_law = dem::LinearSpringDashpot{1e6};
    });
  };
  EXPECT_TRUE(warns(linear(dem::WireContacts::capsules), "\"linear\" with smooth wires"));
  EXPECT_FALSE(warns(linear(dem::WireContacts::beads), "\"linear\" with smooth wires"));
}

/// Springs of a linear law whose stiffness is not in N/m, wires whose modulus is not in Pa.
TEST(Warnings, ContactsThatAreTooSoftToHold) {
  const auto sphere = [](const char* stiffness) {
    return check_scene(load(case_file("bouncing_sphere/scene.toml"),
                            {"solids.contact_law=linear", std::string("solids.normal_stiffness_N_m=") + stiffness}));
  };
  EXPECT_TRUE(warns(sphere("100"), "solids.normal_stiffness_N_m of 100 N/m is small"));
  EXPECT_FALSE(warns(sphere("1e6"), "is small"));
  const auto net = [](const char* modulus) {
    return check_scene(load(case_file("hanging_net/scene.toml"),
                            {"solids.bond_safety=0.5", std::string("materials.steel.youngs_modulus_Pa=") + modulus}));
  };
  EXPECT_TRUE(warns(net("210"), "wires of \"steel\" are softer than rubber"));
  EXPECT_FALSE(warns(net("210e9"), "rubber"));
}

/// Beads that feel the law of grains feel the water; weightings are of resolved bodies.
TEST(Warnings, AveragedGrainsAreNotWarnedOfBodies) {
  const auto report = [](std::vector<std::string> set) {
    set.insert(set.end(), {"coupling.wire_drag=false", "coupling.body_weighting=noble_torczynski"});
    return check_scene(load(case_file("debris_flow/scene.toml"), set));
  };
  const char *const blind = "water does not feel the net", *const leaks = "lets water through bodies";
  EXPECT_TRUE(warns(report({}), blind));
  EXPECT_TRUE(warns(report({}), leaks));
  const std::vector<std::string> averaged{"coupling.grains=averaged", "coupling.averaging_length_m=0.15",
                                          "coupling.beads_as_grains=true"};
  EXPECT_FALSE(warns(report(averaged), blind));
  EXPECT_FALSE(warns(report(averaged), leaks));
}

TEST(Warnings, WallsWithoutANameAreNumbered) {
  const auto report = check_scene(load(case_file("dam_break/scene.toml"),
                                       {"wall[2].shape=sphere", "wall[2].centre_m=[5, 0, 0]", "wall[2].radius_m=0.1"}));
  EXPECT_TRUE(warns(report, "wall[2] stands outside the domain"));
}

TEST(Warnings, KeysThatChangeNothing) {
  const auto report = [](const char* file, std::vector<std::string> set) {
    return check_scene(load(case_file(file), set));
  };
  const char* const two_rates = "solids.two_rates changes nothing";
  EXPECT_TRUE(warns(report("debris_flow/scene.toml", {"solids.two_rates=true"}), "less than twice that of the beads"));
  EXPECT_FALSE(
      warns(report("debris_flow/scene.toml", {"solids.two_rates=true", "solids.time_step_s=1e-6"}), two_rates));
  EXPECT_FALSE(warns(report("debris_flow/scene.toml", {}), two_rates));
  EXPECT_TRUE(warns(report("bouncing_sphere/scene.toml", {"solids.two_rates=true"}), "without fluid, grains and"));
  const char* const no_wires = "run.force_map_interval_s without a barrier";
  EXPECT_TRUE(warns(report("dam_break/scene.toml", {"run.force_map_interval_s=0.1"}), no_wires));
  EXPECT_FALSE(warns(report("debris_flow/scene.toml", {"run.force_map_interval_s=0.1"}), no_wires));
}

/// A key, what it is set to, what lets it have an effect.
TEST(Warnings, KeysThatNeedOthers) {
  const auto changes_nothing = [](const char* file, const std::string& key, std::vector<std::string> set) {
    return warns(check_scene(load(case_file(file), set)), key + " changes nothing");
  };
  const char *const dam = "dam_break/scene.toml", *const debris = "debris_flow/scene.toml",
                    *const ball = "bouncing_sphere/scene.toml";
  EXPECT_TRUE(changes_nothing(dam, "measure.outflow_distance_m", {"measure.outflow_distance_m=0.2"}));
  EXPECT_FALSE(changes_nothing(dam, "measure", {"measure.outflow_distance_m=0.2", "measure.section_x_m=1"}));
  EXPECT_TRUE(changes_nothing(dam, "measure.inflow_distance_m", {"measure.inflow_distance_m=0.2"}));
  EXPECT_TRUE(
      changes_nothing(ball, "measure.inflow_distance_m",
                      {"measure.inflow_distance_m=0.2", "measure.section_x_m=0", "measure.outflow_distance_m=0.2"}));
  EXPECT_FALSE(changes_nothing(dam, "measure", {}));
  EXPECT_TRUE(changes_nothing(dam, "fluid.uncounted_share", {"fluid.uncounted_share=0.01"}));
  EXPECT_FALSE(changes_nothing(dam, "fluid", {"fluid.uncounted_share=0.01", "fluid.adaptive_time_step=true"}));
  const std::string by_share = "coupling.body_weighting=solid_fraction", shift = "coupling.radius_shift_cells";
  EXPECT_TRUE(changes_nothing(debris, shift, {by_share, shift + "=-0.2"}));
  EXPECT_FALSE(changes_nothing(debris, shift, {by_share, shift + "=-0.06"}));
  EXPECT_FALSE(changes_nothing(debris, shift, {shift + "=-0.2"}));
  EXPECT_TRUE(changes_nothing(ball, "solids.bond_safety", {"solids.bond_safety=0.5", "solids.time_step_s=1e-5"}));
  EXPECT_TRUE(changes_nothing(ball, "solids.contact_safety", {"solids.contact_safety=0.1", "solids.time_step_s=1e-5"}));
  EXPECT_FALSE(changes_nothing(ball, "solids", {"solids.contact_safety=0.1"}));
}

TEST(Warnings, StepsOfContactsAboveWhichEnergyIsLost) {
  const auto warned = [](std::vector<std::string> set) {
    return warns(check_scene(load(case_file("bouncing_sphere/scene.toml"), set)), "of an elastic ball that bounces");
  };
  EXPECT_FALSE(warned({"solids.contact_safety=0.3"}));
  EXPECT_TRUE(warned({"solids.contact_safety=0.31"}));
  EXPECT_TRUE(warned({"solids.contact_safety=0.31", "solids.contact_law=linear", "solids.normal_stiffness_N_m=1e6"}));
  EXPECT_FALSE(warned({"solids.time_step_s=1e-6"}));
}

/// Grains among themselves take a longer step than beads, which alone is above the share.
TEST(Warnings, StepsOfTwoRatesAboveWhichEnergyIsLost) {
  const auto report = [](const char* safety) {
    return check_scene(load(case_file("compare_cfd_dem/matched.toml"),
                            {"materials.rock.youngs_modulus_Pa=3.5e9", "solids.two_rates=true",
                             std::string("solids.contact_safety=") + safety}));
  };
  const CheckReport fast = report("0.5");
  const double step = fast.solids->time_step, long_step = static_cast<double>(fast.solids->long_step) * step;
  ASSERT_LT(step, 0.3 * std::min(fast.solids->limits.grain_rayleigh, fast.solids->limits.bead_rayleigh));
  ASSERT_GT(long_step, 0.3 * fast.solids->limits.grain_rayleigh);
  EXPECT_TRUE(warns(fast, "of an elastic ball that bounces"));
  EXPECT_FALSE(warns(report("0.3"), "of an elastic ball that bounces"));
}

TEST(Warnings, ModuliOfTheLinearLaw) {
  const auto report = [](std::vector<std::string> set) {
    return check_scene(load(case_file("bouncing_sphere/scene.toml"), set));
  };
  const auto linear = report({"solids.contact_law=linear", "solids.normal_stiffness_N_m=1e6"});
  EXPECT_TRUE(warns(linear, "solids.contact_modulus_scale changes nothing"));
  EXPECT_FALSE(warns(linear, "contacts are softened"));
  EXPECT_TRUE(warns(report({}), "contacts are softened"));
}

TEST(Warnings, GrainsThatAreFixedNeedNoWalls) {
  const auto report = [](std::vector<std::string> set) {
    set.emplace_back("wall=[]");
    return check_scene(load(case_file("bouncing_sphere/scene.toml"), set));
  };
  EXPECT_TRUE(warns(report({}), "nothing holds them"));
  EXPECT_FALSE(warns(report({"grains.sphere[0].fixed=true"}), "nothing holds them"));
}

TEST(Warnings, RingsThatBreakWhereTheirBeadsOverlap) {
  const auto report = [](std::vector<std::string> set) {
    return check_scene(load(case_file("hanging_net/scene.toml"), set));
  };
  const std::string breaks = "barrier.bonds.ring_tensile_strength_Pa=1e9";
  EXPECT_TRUE(warns(report({breaks, "barrier.net.beads_per_ring=40"}),
                    "beads_per_ring is 40: beads stand 0.90 diameters apart"));
  EXPECT_TRUE(warns(report({breaks, "barrier.net.beads_per_ring=40"}), "36 do not overlap"));
  EXPECT_FALSE(warns(report({breaks}), "do not overlap"));
  EXPECT_FALSE(warns(report({"barrier.net.beads_per_ring=40"}), "do not overlap"));
}

TEST(Warnings, OperatorsThatSmallViscositiesUpset) {
  const auto report = [](std::vector<std::string> set) {
    set.insert(set.end(), {"fluid.collision=trt", "fluid.smagorinsky=0"});
    return check_scene(load(case_file("dam_break/scene.toml"), set));
  };
  EXPECT_TRUE(warns(report({"fluid.kinematic_viscosity_m2_s=1e-3"}), "operator may be unstable there without"));
  EXPECT_FALSE(warns(report({"fluid.kinematic_viscosity_m2_s=0.02"}), "may be unstable"));
  const auto mud = [&](const std::string& consistency) {
    return report({"fluid.rheology.law=herschel_bulkley", "fluid.rheology.yield_stress_Pa=10",
                   "fluid.rheology.limit_viscosity_m2_s=1", "fluid.rheology.exponent=0.5",
                   "fluid.rheology.consistency_Pa_s_n=" + consistency, "fluid.kinematic_viscosity_m2_s=0.02"});
  };
  EXPECT_TRUE(warns(mud("1"), "of the liquid that shears fastest is"));
  EXPECT_FALSE(warns(mud("500"), "may be unstable"));
}

TEST(Warnings, MappedWiresThatShake) {
  const auto warned = [](std::vector<std::string> set) {
    set.insert(set.end(), {"coupling.resolve_wires_from_cells=2", "fluid.cell_size_m=0.003"});
    return warns(check_scene(load(case_file("tutorial/net.toml"), set)), "may shake themselves");
  };
  EXPECT_TRUE(warned({"coupling.body_weighting=wall_distance", "solids.bond_damping_ratio=0.005"}));
  EXPECT_FALSE(warned({"coupling.body_weighting=wall_distance"}));
  EXPECT_FALSE(warned({"coupling.body_weighting=noble_torczynski", "solids.bond_damping_ratio=0.005"}));
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

/// Faces that pass through centres of cells, where the distance is rounded to either side of 0: told is what the run
/// does.
TEST(Warnings, BoxesThroughCentresOfCells) {
  for (const auto& [from, to] : {std::pair(0.015, 0.055), std::pair(0.025, 0.065), std::pair(0.175, 0.215),
                                 std::pair(0.205, 0.305), std::pair(0.215, 0.315)}) {
    const scene::Scene s = scene::load_text(fmt::format(R"([scene]
name = "through_centres"
[run]
duration_s = 0.1
[domain]
lower_m = [0, 0, 0]
upper_m = [0.4, 0.16, 0.3]
[fluid]
enabled = true
cell_size_m = 0.01
[[fluid.region]]
lower_m = [0, 0, 0.2]
upper_m = [0.4, 0.16, 0.25]
[[wall]]
name = "sill"
shape = "box"
lower_m = [{}, 0, 0]
upper_m = [{}, 0.16, 0.1]
)",
                                                        from, to));
    const CheckReport report = check_scene(s);
    const lbm::Domain domain(fluid_options(s).domain);
    std::vector<int> columns;
    for (int x = domain.first().x(); x < domain.first().x() + domain.cells().x(); ++x)
      if (domain.classify({x, 8, 6}) == lbm::CellType::wall) columns.push_back(x - domain.first().x());
    ASSERT_FALSE(columns.empty()) << from;
    const auto told = [&](double face, int cell) {
      return warns(report, fmt::format("x = {:.6g} m acts on the liquid at {:.6g} m", face, 0.01 * cell));
    };
    EXPECT_TRUE(told(from, columns.front())) << testing::PrintToString(report.warnings);
    EXPECT_TRUE(told(to, columns.back() + 1)) << testing::PrintToString(report.warnings);
  }
}

TEST(Warnings, ManyWallsBetweenCellsAreCounted) {
  std::string walls = "wall=[";
  for (int k = 0; k < 40; ++k)
    walls += fmt::format("{{name='pier_{}', shape='box', lower_m=[1, 0, {}], upper_m=[1.2, 0.3, {}]}},", k,
                         0.003 + 0.02 * k, 0.013 + 0.02 * k);
  const CheckReport report = check_scene(load(case_file("dam_break/scene.toml"), {walls + "]"}));
  EXPECT_TRUE(warns(report, "68 more faces of walls act on the liquid elsewhere"));
  EXPECT_LT(report.warnings.size(), 20U);
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

/// Resolved grains and films take mud's own number from a key that water's default stands in.
TEST(Warnings, MudThatBodiesTakeForWater) {
  const auto report = [](std::vector<std::string> set) {
    set.insert(set.end(), {"fluid.rheology.law=herschel_bulkley", "fluid.rheology.yield_stress_Pa=20",
                           "fluid.rheology.consistency_Pa_s_n=10", "fluid.rheology.exponent=0.5",
                           "fluid.rheology.limit_viscosity_m2_s=1", "fluid.smagorinsky=0", "fluid.collision=trt",
                           "coupling.body_weighting=wall_distance"});
    return check_scene(load(case_file("debris_flow/scene.toml"), set));
  };
  EXPECT_TRUE(warns(report({}), "by which bodies and lubrication know the liquid"));
  EXPECT_FALSE(warns(report({"fluid.kinematic_viscosity_m2_s=1e-2"}), "know the liquid"));
  EXPECT_FALSE(warns(report({"coupling.grains=averaged"}), "know the liquid"));
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

/// A plate in the bed halves what particles do to either.
TEST(Warnings, BoxesThatAreFlushWithAPlane) {
  const auto report = [](const std::string& top) {
    return check_scene(
        load(case_file("debris_flow/scene.toml"), {"wall[4]={name='plate', shape='box', material='wall', "
                                                   "lower_m=[5.2, 0.5, -0.1], upper_m=[5.3, 0.7, " +
                                                   top + "]}"}));
  };
  EXPECT_TRUE(warns(report("0"), "\"plate\" ends in the plane of wall"));
  EXPECT_FALSE(warns(report("0.01"), "ends in the plane"));
}

TEST(Warnings, ValuesInOtherUnits) {
  const auto report = [](const std::string& set) {
    return check_scene(load(case_file("debris_flow/scene.toml"), {set}));
  };
  EXPECT_TRUE(warns(report("contact[0].friction=30"), "it is a coefficient"));
  EXPECT_TRUE(warns(report("fluid.density_kg_m3=1.6"), "fluid.density_kg_m3 is 1.6"));
  EXPECT_TRUE(warns(report("barrier.anchors.cable_places=[]"), "no end of a cable but the bottom one is fixed"));
}

/// Beads weigh as spheres, two thirds of the cylinders that mapped wires displace: 1500 kg/m^3 bears them in water.
TEST(Warnings, WiresTooThickForTheDragLaw) {
  const auto warned = [](const std::string& cell) {
    return warns(check_scene(load(case_file("tutorial/net.toml"), {"fluid.cell_size_m=" + cell})),
                 "the drag law drags them too little");
  };
  EXPECT_TRUE(warned("0.0007"));  // 8.7 cells
  EXPECT_FALSE(warned("0.0008"));
}

/// Spheres that are held do not settle.
TEST(Warnings, HeldSpheresHaveNoCellReynoldsNumber) {
  const auto number = [](const char* fixed) {
    return check_scene(load(case_file("debris_flow/scene.toml"),
                            {"grains.packing=[]", "barrier.enabled=false", "measure.section_x_m=2",
                             std::string("grains.sphere=[{position_m=[2, 0.9, 0.5], diameter_m=0.08, "
                                         "density_kg_m3=2500, material='rock', fixed=") +
                                 fixed + "}]"}))
        .solids->cell_reynolds;
  };
  EXPECT_TRUE(number("false").has_value());
  EXPECT_FALSE(number("true").has_value());
}

TEST(Warnings, MappedWiresThatFloat) {
  const auto warned = [](const std::string& density, const std::string& from_cells) {
    return warns(
        check_scene(load(case_file("tutorial/net.toml"),
                         {"fluid.cell_size_m=0.003", "coupling.body_weighting=wall_distance",
                          "coupling.resolve_wires_from_cells=" + from_cells, "barrier.net.density_kg_m3=" + density})),
        "they float up");
  };
  EXPECT_TRUE(warned("1400", "2"));
  EXPECT_FALSE(warned("1600", "2"));
  EXPECT_FALSE(warned("1400", "3")) << "by the drag law";
}

}  // namespace
}  // namespace lahar::cases
