// What `lahar check` and a run warn of: what lies in walls, between cells or outside the domain.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "cases/assembly/build.h"
#include "tests/cases/runner/warns.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::load;

/// A box that ends half a cell or less before the face that it flows to, and one that has room.
TEST(Warnings, AnInflowThatLeaves) {
  const auto report = [](const std::string& lower_upper, const std::string& velocity) {
    return check_scene(load(case_file("dam_break/scene.toml"),
                            {"fluid.inflow=[{name = \"pump\", " + lower_upper +
                             ", discharge_m3_s = [[0, 0.02], [1, 0.02]], velocity_m_s = " + velocity + "}]"}));
  };
  const std::string upstream = "lower_m = [0, 0, 0], upper_m = [0.1, 0.3, 0.2]";
  EXPECT_TRUE(warns(report(upstream, "[-1, 0, 0]"), "fluid.inflow[0] flows towards the domain's x- face"));
  EXPECT_TRUE(warns(report(upstream, "[0.1, 0, -1]"), "fluid.inflow[0] flows towards the domain's z- face"));
  EXPECT_FALSE(warns(report(upstream, "[1, 0, -0.1]"), "flows towards"));
  EXPECT_FALSE(warns(report("lower_m = [0.2, 0, 0], upper_m = [0.3, 0.3, 0.2]", "[-1, 0, 0]"), "flows towards"));
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

TEST(Warnings, WallsWithoutANameAreNumbered) {
  const auto report = check_scene(load(case_file("dam_break/scene.toml"),
                                       {"wall[2].shape=sphere", "wall[2].centre_m=[5, 0, 0]", "wall[2].radius_m=0.1"}));
  EXPECT_TRUE(warns(report, "wall[2] stands outside the domain"));
}

TEST(Warnings, WallsAreNamedOnOneLine) {
  const auto report =
      check_scene(load(case_file("dam_break/scene.toml"), {"wall[2].shape=sphere", "wall[2].name=\"a\\nb\\u009B\"",
                                                           "wall[2].centre_m=[5, 0, 0]", "wall[2].radius_m=0.1"}));
  EXPECT_TRUE(warns(report, R"(wall "a\u000Ab\u009B" stands outside the domain)"));
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

/// A stone of 0.1 m at 0.5 m above the origin's corner, and a box of gravel 0.2 m high.
TEST(Warnings, GrainProbesFarFromAllGrains) {
  const auto report = [](const std::string& point, const std::string& grains) {
    return check_scene(scene::load_text(
        scene::small_scene, {"probe=[{name = \"stone\", kind = \"grain\", position_m = " + point + "}]", grains}));
  };
  const std::string alone = "run.duration_s=1",
                    gravel =
                        "grains.packing=[{lower_m = [0, 0, 0], upper_m = [1, 1, 0.2], sizes = [{diameter_m = 0.02, "
                        "count = 10, density_kg_m3 = 2500, material = \"rock\"}]}]";
  EXPECT_TRUE(warns(report("[0.5, 0.5, 0.8]", alone), "probe[0] follows the nearest grain, which starts 0.25 m"));
  EXPECT_FALSE(warns(report("[0.5, 0.5, 0.64]", alone), "follows"));
  EXPECT_TRUE(warns(report("[0.1, 0.1, 0.45]", gravel), "which starts 0.25 m"));
  EXPECT_FALSE(warns(report("[0.1, 0.1, 0.39]", gravel), "follows"));
  EXPECT_FALSE(warns(report("[0.1, 0.1, 0.1]", gravel), "follows"));
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

}  // namespace
}  // namespace lahar::cases
