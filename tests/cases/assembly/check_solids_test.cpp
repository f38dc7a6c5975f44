// Cross checks of grains, barrier and of what refers to them (check_grains.cpp, check_barrier.cpp, check_uses.cpp).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/cases/assembly/rejections.h"

namespace lahar::scene {
namespace {

class SolidsMistake : public testing::TestWithParam<Rejection> {};

TEST_P(SolidsMistake, IsTheOneMistake) { expect_rejection(case_file("debris_flow/scene.toml"), GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    CrossChecks, SolidsMistake,
    testing::Values(
        Rejection{{"barrier.net.ring_diameter_m=0.0000427", "barrier.net.ring_pitch_m=0.0000366",
                   "barrier.net.wire_diameter_m=0.000003"},
                  "barrier.net",
                  "GB of this machine"},
        Rejection{{"grains.packing[0].upper_m=[0.75, 1.8, -1]"}, "grains.packing[0].upper_m", "is not above lower_m"},
        Rejection{
            {"grains.packing[0].upper_m=[0.75, 1.8, 1.6]"}, "grains.packing[0] reaches outside the domain", "expected"},
        Rejection{{"grains.packing[0].upper_m=[0.75, 1.8, 0.4]"}, "grains.packing[0]: grains fill", "at most 0.74"},
        Rejection{{"grains.packing[0].sizes=[]"}, "grains.packing[0] has no grains", "sizes"},
        Rejection{{"grains.packing[0].sizes[1].diameter_m=0.8", "grains.packing[0].sizes[1].count=1"},
                  "grains.packing[0].sizes[1].diameter_m",
                  "smallest extent of the box"},
        Rejection{{"grains.packing[0].sizes[0].diameter_m=0.009"},
                  "grains.packing[0].sizes[0].diameter_m is 0.009 m",
                  "at least a cell of the fluid"},
        Rejection{{"grains.sphere[0].position_m=[3, 0.9, 0.65]", "grains.sphere[0].diameter_m=0.009",
                   "grains.sphere[0].density_kg_m3=2500", "grains.sphere[0].material=rock"},
                  "grains.sphere[0].diameter_m is 0.009 m",
                  "at least a cell of the fluid"},
        Rejection{{"wall[0].point_m=[0, 0, 0.1]", "barrier.net.origin_m=[4.1, 0, 0.1]"},
                  "grains.packing[0] reaches 0.1 m into wall[0]",
                  "free space"},
        Rejection{{"wall[1].point_m=[0.1, 0, 0]"}, "grains.packing[0] reaches 0.1 m into wall[1]", "free space"},
        Rejection{{"barrier.net.origin_m=[0.5, 0, 0]", "measure.section_x_m=4.1"},
                  "grains.packing[0] holds",
                  "beads of the barrier, expected it beside"},
        Rejection{{"grains.sphere[0].position_m=[4.1, 0.9, 0.5]", "grains.sphere[0].diameter_m=0.4",
                   "grains.sphere[0].density_kg_m3=2500", "grains.sphere[0].material=rock"},
                  "grains.sphere[0] overlaps the barrier",
                  "expected a gap"},
        Rejection{{"grains.sphere[0].position_m=[0.3, 0.9, 0.65]", "grains.sphere[0].diameter_m=0.3",
                   "grains.sphere[0].density_kg_m3=2500", "grains.sphere[0].material=rock"},
                  "grains.sphere[0] reaches into grains.packing[0]",
                  "beside the packing"},
        Rejection{{"grains.sphere[0].position_m=[3, 0.9, 0.65]", "grains.sphere[0].diameter_m=0.1",
                   "grains.sphere[0].density_kg_m3=2500", "grains.sphere[0].material=rock",
                   "grains.sphere[0].velocity_m_s=[300, 0, 0]"},
                  "grains.sphere[0].velocity_m_s is 300 m/s",
                  "at most 200 m/s"},
        Rejection{{"barrier.bonds.dissipator_stiffness_N_m3=[8e10, 8e9, 8e11]",
                   "barrier.bonds.dissipator_force_limit_N=[2000, 4000]", "barrier.bonds.plastic_unloading=true"},
                  "barrier.bonds.plastic_unloading",
                  "expected softer ones"},
        Rejection{{"barrier.net.beads_per_ring=27", "barrier.net.bead_inertia_scale=1",
                   "barrier.bonds.ring_stiffness_N_m3=8e11", "materials.steel.youngs_modulus_Pa=1e10",
                   "materials.rock.youngs_modulus_Pa=1e9", "solids.bond_safety=0.9"},
                  "solids.bond_safety is 0.9",
                  "the barrier as built allows"},
        Rejection{{"barrier.net.width_m=1.86"}, "barrier.net.width_m", "outside the domain"},
        Rejection{
            {"domain.upper_m=[5.6, 1.9, 1.5]", "barrier.net.width_m=1.86"}, "barrier.net.width_m", "outside the walls"},
        Rejection{{"barrier.net.origin_m=[4.1, 0, 0.6]"}, "barrier.net.height_m", "outside the domain"},
        Rejection{{"barrier.net.origin_m=[4.1, 0, -0.1]"}, "barrier.net.origin_m", "outside the domain"},
        Rejection{{"barrier.net.height_m=0.06"}, "barrier.net.height_m", "at least a ring and its cables, 0.0822"},
        Rejection{{"barrier.net.height_m=0.24"}, "barrier.net: ", "would do"},
        Rejection{{"barrier.net.width_direction=[0, 0, 0]"}, "barrier.net.width_direction", "is zero"},
        Rejection{{"barrier.net.height_direction=[0, 1, 1]"}, "barrier.net.height_direction", "right angles"},
        Rejection{{"barrier.net.ring_diameter_m=0.062", "barrier.net.beads_per_ring=32"}, "barrier.net: ", "interlock"},
        Rejection{{"barrier.net.beads_per_ring=20"}, "barrier.net: beads of a ring", "pass through each other"},
        Rejection{{"barrier.net.beads_per_ring=60"}, "barrier.net: beads of a ring", "overlap"},
        Rejection{{"barrier.net.ring_pitch_m=0.03"}, "barrier.net: ", "interlock"},
        Rejection{{"barrier.net.ring_pitch_m=1e-18"},
                  "barrier.net: rings at a pitch of 1e-18 m",
                  "expected more than the wire, 0.0061 m"},
        Rejection{{"barrier.net.ring_diameter_m=0"}, "barrier.net.ring_diameter_m", "above 0"},
        Rejection{{"barrier.anchors.cable_places=[0, 1.2]"}, "barrier.anchors.cable_places", "from 0 to 1"},
        Rejection{{"barrier.bonds.dissipator_places=[-0.1]"}, "barrier.bonds.dissipator_places", "from 0 to 1"},
        Rejection{{"barrier.bonds.dissipator_places=[0, 0.001, 1]"}, "barrier.net: two dissipators", "farther apart"},
        Rejection{{"barrier.bonds.cable_stiffness_N_m3=1e18"}, "barrier.bonds.cable_stiffness_N_m3", "allows 1e-08 s"},
        Rejection{{"barrier.bonds.dissipator_stiffness_N_m3=[1e19, 1]"},
                  "barrier.bonds.dissipator_stiffness_N_m3",
                  "needs a time step"},
        Rejection{
            {"barrier.bonds.dissipator_stiffness_N_m3=[8e11]"}, "barrier.bonds.dissipator_stiffness_N_m3", "1 entry"},
        Rejection{
            {"barrier.bonds.dissipator_force_limit_N=[]"}, "barrier.bonds.dissipator_force_limit_N", "expected 1"},
        Rejection{
            {"barrier.bonds.dissipator_stiffness_N_m3=[3, 2, 3]", "barrier.bonds.dissipator_force_limit_N=[5, 4]"},
            "barrier.bonds.dissipator_force_limit_N",
            "does not rise"},
        Rejection{{"fluid.enabled=false"}, "coupling.enabled", "without a fluid"},
        Rejection{
            {"coupling.solid_operator='holdych'", "coupling.body_weighting='wall_distance'", "fluid.smagorinsky=0"},
            "coupling.solid_operator",
            "another body_weighting"},
        Rejection{
            {"coupling.solid_operator='holdych'", "coupling.body_weighting='noble_torczynski'", "fluid.smagorinsky=0"},
            "coupling.solid_operator",
            "expected fixed grains"},
        Rejection{{"coupling.body_weighting='inertial'", "coupling.resolve_wires_from_cells=3"},
                  "coupling.body_weighting",
                  "lets too much through wires"},
        Rejection{{"coupling.body_weighting='inertial'", "fluid.smagorinsky=0", "fluid.rheology.law=bingham",
                   "fluid.rheology.yield_stress_Pa=10", "fluid.rheology.limit_viscosity_m2_s=1"},
                  "coupling.body_weighting",
                  "says little of mud"},
        Rejection{{"coupling.solid_operator='bounce_back'", "fluid.smagorinsky=0.1"},
                  "coupling.solid_operator",
                  "a constant viscosity alone"},
        Rejection{{"coupling.solid_operator='bounce_back'", "fluid.smagorinsky=0"},
                  "coupling.solid_operator",
                  "B up to 1.25"},
        Rejection{
            {"coupling.solid_operator='bounce_back'", "coupling.body_weighting='wall_distance'", "fluid.smagorinsky=0"},
            "coupling.solid_operator",
            "B up to 1.25"},
        Rejection{{"solids.time_step_s=1e-13"}, "solids.time_step_s", "expected at most 1e+06"},
        Rejection{{"coupling.grains='averaged'", "coupling.lubrication=true"},
                  "coupling.lubrication",
                  "for what resolved grains miss"},
        Rejection{{"coupling.grains='averaged'", "coupling.averaging_length_m=0.005"},
                  "coupling.averaging_length_m",
                  "at least a cell"},
        Rejection{{"coupling.grains='averaged'", "coupling.resolve_wires_from_cells=3"},
                  "coupling.resolve_wires_from_cells",
                  "expected none with grains"},
        Rejection{{"coupling.grains='averaged'", "coupling.solid_operator='faded'"},
                  "coupling.solid_operator",
                  "expected none with grains"},
        Rejection{{"coupling.grains='averaged'", "coupling.solid_operator='bounce_back'"},
                  "coupling.solid_operator",
                  "expected none with grains"},
        Rejection{{"coupling.lubrication=true", "grains.packing=[]"}, "coupling.lubrication", "without grains"},
        Rejection{{"barrier.bonds.dissipator_stiffness_N_m3=[]", "barrier.bonds.dissipator_force_limit_N=[]",
                   "barrier.bonds.plastic_unloading=true"},
                  "barrier.bonds.plastic_unloading",
                  "expected the stiffness"},
        Rejection{{"barrier.bonds.dissipator_stiffness_N_m3=[]", "barrier.bonds.dissipator_force_limit_N=[]",
                   "barrier.bonds.dissipator_places=[0.5]"},
                  "barrier.bonds.dissipator_places",
                  "expected the stiffness"},
        Rejection{{"coupling.bed_drag='gidaspow'"}, "coupling.bed_drag", "averaged"},
        Rejection{{"domain.periodic_axes=['y']"}, "domain.periodic_axes", "expected fluid alone"},
        Rejection{{"measure.outflow_distance_m=2"}, "measure.outflow_distance_m", "leads to x = 6.1"}));

class SphereMistake : public testing::TestWithParam<Rejection> {};

TEST_P(SphereMistake, IsTheOneMistake) { expect_rejection(case_file("bouncing_sphere/scene.toml"), GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    CrossChecks, SphereMistake,
    testing::Values(
        Rejection{{"grains.sphere[0].position_m=[0, 0, 2]"}, "grains.sphere[0].position_m", "outside the domain"},
        Rejection{{"grains.sphere[0].position_m=[0, 0, 0.02]"}, "grains.sphere[0] is inside wall[0]", "free space"},
        Rejection{{"grains.sphere[0].diameter_m=1.05"}, "grains.sphere[0].diameter_m", "smallest extent of the domain"},
        Rejection{{"grains.sphere[1].position_m=[0, 0.05, 0.55]", "grains.sphere[1].diameter_m=0.1",
                   "grains.sphere[1].density_kg_m3=1", "grains.sphere[1].material=steel"},
                  "grains.sphere[1] overlaps grains.sphere[0]",
                  "gap"},
        Rejection{{"grains.sphere[0].fixed=true", "grains.sphere[0].velocity_m_s=[1, 0, 0]"},
                  "grains.sphere[0].fixed",
                  "no velocity and no spin"},
        Rejection{{"grains.sphere[0].angular_velocity_rad_s=[0, 3000, 4000]"},
                  "grains.sphere[0].angular_velocity_rad_s is 5000 rad/s, which moves its surface at 250 m/s",
                  "expected at most 200 m/s"},
        Rejection{{"grains.sphere[0].angular_velocity_rad_s=[1e20, 0, 0]"},
                  "grains.sphere[0].angular_velocity_rad_s",
                  "expected at most 200 m/s"},
        Rejection{{"grains.sphere=[]"}, "the scene is empty", "expected a fluid, grains or a barrier"},
        Rejection{{"probe[0].name=p", "probe[0].kind=pressure", "probe[0].position_m=[0, 0, 0.5]"},
                  "probe[0] without a fluid",
                  "fluid.enabled"}));

/// Of many spheres in one place all but the first are to blame, each once; those elsewhere are fine.
/// Also where the message names another key, which stands in the file or is a default.
TEST(CheckSolids, WhatTheCommandLineChangedIsToBlame) {
  const auto blames = [](const char* file, const std::string& text) {
    const auto mistakes = mistakes_in(case_file(file), {text});
    ASSERT_FALSE(mistakes.empty()) << text;
    for (const std::string& m : mistakes) EXPECT_TRUE(m.starts_with("--set " + text + ":1:1: ")) << m;
  };
  blames("debris_flow/scene.toml", "barrier.net.ring_diameter_m=5");
  blames("debris_flow/scene.toml", "barrier.net.origin_m=[4.1, 0.5, 0]");
  blames("debris_flow/scene.toml", "barrier.net.ring_pitch_m=0.03");
  blames("debris_flow/scene.toml", "barrier.net.width_direction=[0, 1, 1]");
  blames("debris_flow/scene.toml", "grains.packing[0].upper_m=[0.75, 1.8, 1.6]");
  blames("debris_flow/scene.toml", "grains.packing[0].lower_m=[0.75, 0, 0]");
  blames("tutorial/net.toml", "barrier.net.origin_m=[0.9, 0.01, 0]");
  blames("dam_break/scene.toml", "fluid.region[0].lower_m=[0, 0, 5]");
}

/// The distance upstream is for the energy of a flow.
TEST(CheckSolids, WithoutAFluidNothingIsMeasuredUpstream) {
  EXPECT_TRUE(mistakes_in(case_file("bouncing_sphere/scene.toml"), {"measure.section_x_m=-0.4"}).empty());
}

TEST(CheckSolids, SpheresThatOverlapAreBlamedOnce) {
  std::vector<std::string> changes;
  const auto place = [&](int i, double x, double y, double z) {
    const std::string path = "grains.sphere[" + std::to_string(i) + "].";
    for (const std::string& value : {fmt::format("position_m=[{}, {}, {}]", x, y, z), std::string("diameter_m=0.02"),
                                     std::string("density_kg_m3=2500"), std::string("material=steel")})
      changes.push_back(path + value);
  };
  for (int i = 0; i < 60; ++i) place(i, 0.03 * (i % 5) - 0.06, 0.03 * (i / 5 % 4) - 0.05, 0.3 + 0.03 * (i / 20));
  EXPECT_TRUE(mistakes_in(case_file("bouncing_sphere/scene.toml"), changes).empty());
  for (const int i : {41, 7, 59}) place(i, 0.06, -0.02, 0.33);  // in number 29
  const std::vector<std::string> mistakes = mistakes_in(case_file("bouncing_sphere/scene.toml"), changes);
  ASSERT_EQ(mistakes.size(), 3u);
  for (const char* pair : {"grains.sphere[29] overlaps grains.sphere[7]", "grains.sphere[41] overlaps grains.sphere[7]",
                           "grains.sphere[59] overlaps grains.sphere[7]"})
    EXPECT_EQ(std::count_if(mistakes.begin(), mistakes.end(),
                            [&](const std::string& m) { return m.find(pair) != std::string::npos; }),
              1)
        << pair;
}

/// Above what a packing will fill a sphere has room, even in its box.
TEST(CheckSolids, ASphereAboveAPackingIsFine) {
  EXPECT_TRUE(mistakes_in(case_file("debris_flow/scene.toml"),
                          {"grains.sphere[0].position_m=[0.3, 0.9, 1.2]", "grains.sphere[0].diameter_m=0.3",
                           "grains.sphere[0].density_kg_m3=2500", "grains.sphere[0].material=rock"})
                  .empty());
}

/// A packing of one grain is as high as that grain.
TEST(CheckSolids, ASphereInTheOnlyGrainOfAPackingIsAMistake) {
  const auto mistakes =
      mistakes_in(case_file("bouncing_sphere/scene.toml"),
                  {"grains.sphere[0].position_m=[0, 0, 0.25]", "grains.packing[0].lower_m=[-0.4, -0.4, 0]",
                   "grains.packing[0].upper_m=[0.4, 0.4, 0.6]", "grains.packing[0].sizes[0].diameter_m=0.3",
                   "grains.packing[0].sizes[0].count=1", "grains.packing[0].sizes[0].density_kg_m3=2500",
                   "grains.packing[0].sizes[0].material=steel"});
  ASSERT_EQ(mistakes.size(), 1U) << (mistakes.empty() ? "" : mistakes[0]);
  EXPECT_NE(mistakes[0].find("reaches into grains.packing[0]"), std::string::npos) << mistakes[0];
}

TEST(CheckSolids, TouchingSpheresAndFixedOnesInWallsAreFine) {
  EXPECT_TRUE(
      mistakes_in(case_file("bouncing_sphere/scene.toml"), {"grains.sphere[0].position_m=[0, 0, 0.05]"}).empty());
  EXPECT_TRUE(mistakes_in(case_file("bouncing_sphere/scene.toml"),
                          {"grains.sphere[0].position_m=[0, 0, 0]", "grains.sphere[0].fixed=true"})
                  .empty());
}

TEST(CheckSolids, ABoxMayReachOverTheNetWhereItsGrainsDoNot) {
  const std::vector<std::string> high{"barrier.net.origin_m=[0.5, 0, 0.54]", "barrier.net.height_m=0.48",
                                      "measure.section_x_m=4.1"};
  EXPECT_EQ(mistakes_in(case_file("debris_flow/scene.toml"), high).size(), 1u);
  std::vector<std::string> low = high;
  low.push_back("barrier.net.origin_m=[0.5, 0, 0.6]");
  EXPECT_TRUE(mistakes_in(case_file("debris_flow/scene.toml"), low).empty());
}

/// Beads have a radius: a packing that ends a millimetre before their centres is in the wires.
TEST(CheckSolids, APackingMayNotTouchTheNet) {
  const auto ends_at = [](const char* x) {
    return mistakes_in(case_file("debris_flow/scene.toml"), {fmt::format("grains.packing[0].upper_m=[{}, 1.8, 1.5]", x),
                                                             "barrier.net.origin_m=[0.8, 0, 0]"});
  };
  EXPECT_EQ(ends_at("0.75").size(), 0U);
  const auto inside = ends_at("0.796");
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_NE(inside.front().find("beads of the barrier"), std::string::npos) << inside.front();
}

/// A net that stands on a corner: of its four corners the upper one alone leaves the domain.
TEST(CheckSolids, EveryCornerOfTheNetIsInTheDomain) {
  const auto net = case_file("hanging_net/scene.toml");
  const std::vector<std::string> on_a_corner{"barrier.net.origin_m=[0, 0, 0]", "barrier.net.width_direction=[0, 1, 1]",
                                             "barrier.net.height_direction=[0, -1, 1]",
                                             "domain.lower_m=[-0.2, -0.3, -0.1]", "domain.upper_m=[0.2, 0.5, 0.5]"};
  EXPECT_TRUE(mistakes_in(net, on_a_corner).empty());
  std::vector<std::string> low = on_a_corner;
  low.back() = "domain.upper_m=[0.2, 0.5, 0.4]";
  expect_rejection(net, {low, "barrier.net.width_m", "0.452548) lies outside the domain"});
}

TEST(CheckSolids, TheSectionIsTheNetsPlaneUnlessGiven) {
  EXPECT_EQ(debris_flow().measure.section_x, 4.1);
  EXPECT_EQ(load(case_file("debris_flow/scene.toml"),
                 {"measure.section_x_m=4", "barrier.net.width_m=0.38", "barrier.net.height_m=0.26"})
                .measure.section_x,
            4.0);
  EXPECT_FALSE(load(case_file("hanging_net/scene.toml")).measure.section_x.has_value());
}

}  // namespace
}  // namespace lahar::scene
