#include "cases/assembly/load_shapes.h"

#include <gtest/gtest.h>

#include "cases/assembly/build.h"
#include "cases/assembly/geometry.h"
#include "cases/scene/writer.h"
#include "tests/cases/assembly/rejections.h"
#include "tests/cases/files/shape_texts.h"

namespace lahar::scene {
namespace {

using cases::obj_text;
using cases::stl_text;

const std::string tank = R"([scene]
name = "shapes"
[run]
duration_s = 0.1
[domain]
lower_m = [0, 0, 0]
upper_m = [1, 0.5, 0.5]
open_faces = ["z+"]
[fluid]
enabled = true
cell_size_m = 0.02
)";
const std::string region = "[[fluid.region]]\nlower_m = [0, 0, 0]\nupper_m = [0.3, 0.5, 0.3]\n";
const std::string block = R"([[wall]]
name = "block"
shape = "mesh"
file = "block.stl"
scale = 0.001
translate_m = [0.5, 0.1, 0.0]
)";
const std::string ground = "[[wall]]\nshape = \"heightmap\"\nfile = \"ground.txt\"\nspacing_m = 0.5\n";

TEST(LoadShapes, AMeshStandsWhereItIsPut) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch.path() / "data");
  scratch.write("data/block.stl", stl_text(box_mesh(Vec3(0, 0, -50), Vec3(200, 300, 150))));  // mm
  scratch.write("data/base.toml", tank + region + block);
  const Scene s = load(scratch.write("scene.toml", "[scene]\nbase = \"data/base.toml\"\n"));
  const Walls walls = make_walls(s);
  const SolidBox exact{Vec3(0.5, 0.1, -0.05), Vec3(0.7, 0.4, 0.15)};
  for (const Vec3& p : {Vec3(0.51, 0.2, 0.1), Vec3(0.6, 0.25, 0.16), Vec3(0.45, 0.2, 0.02), Vec3(0.6, 0.42, 0.1)})
    EXPECT_NEAR(walls.distance(0, p), exact.distance(p), 1e-4) << p.transpose();
  EXPECT_EQ(s.walls[0].file.file, (scratch.path() / "data/block.stl").string());
  const Scene again = load(scratch.write("resolved.toml", to_toml(s)));
  EXPECT_TRUE(again == s);
  EXPECT_EQ(make_walls(again).distance(0, Vec3(0.45, 0.2, 0.02)), walls.distance(0, Vec3(0.45, 0.2, 0.02)));
}

/// A mistake that keeps files from being read is the one that is reported, whatever stands in them.
TEST(LoadShapes, AMistakeInGrainsLeavesFilesAlone) {
  const ScratchFolder scratch;
  scratch.write("block.stl", stl_text(box_mesh(Vec3(0, 0, -50), Vec3(200, 300, 150))));
  const auto file = scratch.write("scene.toml", tank + region + block);
  const auto all = mistakes_in(
      file,
      {"fluid.region=[{shape = \"mesh\", file = \"block.stl\", scale = 0.001}]",
       "materials.rock={youngs_modulus_Pa = 1e9, poisson_ratio = 0.3}", "wall[0].material=rock",
       "grains.sphere=[{position_m = [0.2, 0.2, 0.2], diameter_m = -1, density_kg_m3 = 2500, material = \"rock\"}]"});
  ASSERT_EQ(all.size(), 1U) << all.back();
  EXPECT_NE(all[0].find("grains.sphere[0].diameter_m is -1"), std::string::npos) << all[0];
}

/// Spheres and cylinders need no file: where files are left alone, nothing else is said of them.
TEST(LoadShapes, AMistakeInGrainsIsTheOnlyOne) {
  const auto all =
      mistakes_in(case_file("dam_break/scene.toml"),
                  {"domain.lower_m=[-1, 0, 0]", "domain.upper_m=[-0.2, 0.3, 0.8]", "probe=[]",
                   "fluid.region=[{shape = \"sphere\", centre_m = [-0.6, 0.15, 0.3], radius_m = 0.1}]",
                   "materials.rock={youngs_modulus_Pa = 1e9, poisson_ratio = 0.3}", "wall[0].material=rock",
                   "wall[1].material=rock",
                   "grains.sphere=[{position_m = [-0.6, 0.1, 0.2], diameter_m = -1, density_kg_m3 = 2500, material = "
                   "\"rock\"}]"});
  ASSERT_EQ(all.size(), 1U) << all.back();
  EXPECT_NE(all[0].find("grains.sphere[0].diameter_m is -1"), std::string::npos) << all[0];
}

TEST(LoadShapes, AHeightmapIsTheGround) {
  const ScratchFolder scratch;
  scratch.write("ground.txt", "0.2 0.1 0.0\n0.2 0.1 0.0\n");  // falls by 0.2 along x
  const Scene s = load(scratch.write("scene.toml", tank + region + ground));
  const Walls walls = make_walls(s);
  const double cosine = 1 / std::sqrt(1.04);
  for (const double x : {0.1, 0.35, 0.9})
    for (const double z : {-0.03, 0.0, 0.03})
      EXPECT_NEAR(walls.distance(0, Vec3(x, 0.3, 0.2 - 0.2 * x + z)), z * cosine, 1e-5);
  EXPECT_LT((walls.gradient(0, Vec3(0.5, 0.2, 0.11)) - Vec3(0.2, 0, 1).normalized()).norm(), 1e-3);
  const lbm::Domain domain(cases::fluid_options(s).domain);
  EXPECT_EQ(domain.classify(domain.cell_at(Vec3(0.05, 0.25, 0.15))), lbm::CellType::wall);
  EXPECT_EQ(domain.classify(domain.cell_at(Vec3(0.05, 0.25, 0.23))), lbm::CellType::gas);
}

/// Liquid in a mesh, a ball and a cylinder: as much as they hold, with its own velocity.
TEST(LoadShapes, LiquidOfAnyShape) {
  const ScratchFolder scratch;
  scratch.write("drop.obj", obj_text(box_mesh(Vec3(0.013, 0.05, 0.107), Vec3(0.213, 0.25, 0.3))));
  const std::string shapes = R"([[fluid.region]]
shape = "mesh"
file = "drop.obj"
velocity_m_s = [1, 0, 0]
[[fluid.region]]
shape = "sphere"
centre_m = [0.41, 0.213, 0.251]
radius_m = 0.12
[[fluid.region]]
shape = "cylinder"
start_m = [0.6, 0.3, 0.2]
end_m = [0.9, 0.3, 0.2]
radius_m = 0.08
)";
  const Scene s =
      load(scratch.write("scene.toml", tank + shapes), {"gravity.magnitude_m_s2=0", "fluid.max_speed_m_s=2"});
  EXPECT_EQ(s.fluid.regions[2].lower, Vec3(0.6, 0.3 - 0.08, 0.2 - 0.08));
  lbm::Fluid<double> fluid(cases::fluid_options(s));
  fluid.fill(cases::liquid_regions(s));
  const double volumes[] = {0.2 * 0.2 * 0.193, 4 * M_PI / 3 * std::pow(0.12, 3), M_PI * 0.08 * 0.08 * 0.3};
  double found[3] = {0, 0, 0};
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    const int k = c.centre.x() < 0.25 ? 0 : c.centre.x() < 0.57 ? 1 : 2;
    found[k] += c.liquid_volume;
    EXPECT_NEAR(c.velocity.x(), k == 0 ? 1 : 0, 1e-9);
  });
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], volumes[k], 0.01 * volumes[k]) << k;
}

/// Water of still.obj, or of a box, 0.3 m deep in a tank that it fills from wall to wall.
const std::string still_tank = R"([scene]
name = "still"
[run]
duration_s = 0.1
[domain]
lower_m = [0, 0, 0]
upper_m = [0.4, 0.2, 0.5]
open_faces = ["z+"]
slip = "free_slip"
[fluid]
enabled = true
cell_size_m = 0.02
max_speed_m_s = 2.5
[[fluid.region]]
)";

/// The largest speed after 100 steps, lu.
double speed_later(lbm::Fluid<double>& fluid) {
  for (int k = 0; k < 100; ++k) fluid.step();
  return fluid.max_speed_lu();
}

/// The mesh of a box is that box, also where it reaches out of the domain: there it is cut off.
TEST(LoadShapes, LiquidInTheMeshOfABoxIsThatInTheBox) {
  const ScratchFolder scratch;
  const Scene box = load(scratch.write("box.toml", still_tank + "lower_m = [0, 0, 0]\nupper_m = [0.4, 0.2, 0.3]\n"));
  const auto scene = scratch.write("scene.toml", still_tank + "shape = \"mesh\"\nfile = \"still.obj\"\n");
  lbm::Fluid<double> one(cases::fluid_options(box));
  one.fill(cases::liquid_regions(box));
  for (const double beyond : {0.0, 0.05}) {
    scratch.write("still.obj", obj_text(box_mesh(Vec3::Constant(-beyond), Vec3(0.4 + beyond, 0.2 + beyond, 0.3))));
    ASSERT_EQ(mistakes_in(scene), std::vector<std::string>{});
    const Scene s = load(scene);
    lbm::Fluid<double> fluid(cases::fluid_options(s));
    fluid.fill(cases::liquid_regions(s));
    EXPECT_NEAR(fluid.liquid_mass() / one.liquid_mass(), 1, 1e-9);
    fluid.for_each_wet_cell([&](const lbm::WetCell& c) { EXPECT_EQ(c.fill_level, 1) << c.centre.transpose(); });
    EXPECT_LT(speed_later(fluid), 1e-3);
  }
}

/// So is the mesh of a basin whose sides are oblique to the lattice and lie between its points.
TEST(LoadShapes, LiquidInAMeshBetweenObliqueWallsIsAtRest) {
  const ScratchFolder scratch;
  const Vec3 middle(0.203, 0.098, 0), half(0.1087, 0.0523, 0);
  const Eigen::AngleAxisd turn(20 * M_PI / 180, Vec3::UnitZ());
  TriangleMesh mesh = box_mesh(-half, half + Vec3(0, 0, 0.3));
  for (Vec3& p : mesh.points) p = middle + turn * p;
  scratch.write("still.obj", obj_text(mesh));
  std::string text = still_tank + "shape = \"mesh\"\nfile = \"still.obj\"\n";
  for (const Vec3& side : {Vec3(half.x(), 0, 0), Vec3(0, half.y(), 0)})
    for (const int sign : {-1, 1}) {
      const Vec3 point = middle + sign * (turn * side), normal = -sign * (turn * side);
      text += fmt::format("[[wall]]\nshape = \"plane\"\nslip = \"free_slip\"\npoint_m = [{}, {}, 0]\n", point.x(),
                          point.y()) +
              fmt::format("normal = [{}, {}, 0]\n", normal.x(), normal.y());
    }
  const Scene s = load(scratch.write("scene.toml", text));
  lbm::Fluid<double> fluid(cases::fluid_options(s));
  fluid.fill(cases::liquid_regions(s));
  std::size_t cells = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    EXPECT_TRUE(c.fill_level == 1 || c.centre.z() > 0.28) << c.centre.transpose();
    ++cells;
  });
  EXPECT_GT(cells, 500u);
  EXPECT_LT(speed_later(fluid), 1e-3);
}

/// Also where it is so near that walls would still feel it.
TEST(LoadShapes, LiquidBesideTheDomainIsAMistake) {
  const ScratchFolder scratch;
  scratch.write("still.obj", obj_text(box_mesh(Vec3(-0.1, 0, 0), Vec3(-0.01, 0.2, 0.3))));
  const auto all = mistakes_in(scratch.write("scene.toml", still_tank + "shape = \"mesh\"\nfile = \"still.obj\"\n"));
  ASSERT_EQ(all.size(), 1U) << testing::PrintToString(all);
  EXPECT_NE(all[0].find("lies outside the domain"), std::string::npos) << all[0];
}

/// Beside the file that names it, also where that is a change of a base.
TEST(LoadShapes, AChangedFileIsLookedForBesideTheScene) {
  const ScratchFolder scratch;
  scratch.write("base.toml", tank + region + ground);
  std::filesystem::create_directory(scratch.path() / "maps");
  scratch.write("maps/ground.txt", "0.2 0.1 0.0\n0.2 0.1 0.0\n");
  const auto scene = scratch.write("scene.toml",
                                   "[scene]\nname = \"changed\"\nbase = \"base.toml\"\nchanges = ["
                                   "\"wall[0].file = \\\"maps/ground.txt\\\"\"]\n");
  EXPECT_EQ(mistakes_in(scene).size(), 0U) << testing::PrintToString(mistakes_in(scene));
}

/// Of ground of ten kilometres what lies in the domain is sampled, and takes the memory of that.
TEST(LoadShapes, AMeshMayBeMuchLargerThanTheDomain) {
  const ScratchFolder scratch;
  scratch.write("block.stl", stl_text(box_mesh(Vec3(-5e6, -5e6, -2e3), Vec3(5e6, 5e6, 50))));
  const auto scene = scratch.write("scene.toml", tank + region + block);
  ASSERT_EQ(mistakes_in(scene), std::vector<std::string>{});
  const Walls walls = make_walls(load(scene));
  for (const double z : {0.03, 0.06, 0.11}) EXPECT_NEAR(walls.distance(0, Vec3(0.4, 0.2, z)), z - 0.05, 1e-4) << z;
}

/// Told where the key stands that moved it away, with both extents.
TEST(LoadShapes, AMeshOutsideTheDomainSaysWhereItLies) {
  const ScratchFolder scratch;
  scratch.write("block.stl", stl_text(box_mesh(Vec3(0, 0, 0), Vec3(200, 300, 150))));
  const auto scene = scratch.write("scene.toml", tank + region + block);
  for (const std::string set : {"wall[0].translate_m=[5, 0, 0]", "domain.upper_m=[0.4, 0.5, 0.5]"}) {
    const auto all = mistakes_in(scene, {set});
    ASSERT_EQ(all.size(), 1U) << testing::PrintToString(all);
    EXPECT_TRUE(all[0].starts_with("--set " + set)) << all[0];
  }
  const std::string moved = mistakes_in(scene, {"wall[0].translate_m=[5, 0, 0]"}).at(0);
  EXPECT_NE(moved.find("lies outside the domain, from (5, 0, 0) to (5.2, 0.3, 0.15) m, expected a part of it inside, "
                       "from (0, 0, 0) to (1, 0.5, 0.5) m"),
            std::string::npos)
      << moved;
  const std::string grown = mistakes_in(scene, {"wall[0].scale=1e-6"}).at(0);
  EXPECT_TRUE(grown.starts_with("--set wall[0].scale=1e-6")) << grown;
}

/// The names of their folders and files may hold a line break.
TEST(LoadShapes, FilesAreNamedOnOneLine) {
  const ScratchFolder scratch;
  const std::string folder = "a\nb \xfc";
  std::filesystem::create_directory(scratch.path() / folder);
  scratch.write(folder + "/block.stl", stl_text(box_mesh(Vec3(0, 0, -50), Vec3(200, 300, 150))));
  const auto not_utf8 = mistakes_in(scratch.write(folder + "/scene.toml", tank + region + block));
  ASSERT_EQ(not_utf8.size(), 1U) << testing::PrintToString(not_utf8);
  EXPECT_NE(not_utf8[0].find("/a\\u000Ab \xfc/block.stl\" is not UTF-8, expected folders"), std::string::npos)
      << not_utf8[0];
  scratch.write("gro\nund.txt", "0.2 0.1 0.0\n0.2 0.1 0.0\n");
  const auto beside = mistakes_in(
      scratch.write("scene.toml", tank + region + ground),
      {"wall[0].file=\"" + (scratch.path() / "gro").string() + "\\nund.txt\"", "wall[0].translate_m=[70, 0, 0]"});
  ASSERT_EQ(beside.size(), 1U) << testing::PrintToString(beside);
  EXPECT_NE(beside[0].find("/gro\\u000Aund.txt\" covers x from 69.75 to 71.25 m"), std::string::npos) << beside[0];
}

class WrongShape : public testing::TestWithParam<Rejection> {};

/// A good scene with a mesh, a terrain and a liquid ball, changed in one way.
TEST_P(WrongShape, IsTheOneMistake) {
  const ScratchFolder scratch;
  scratch.write("block.stl", stl_text(box_mesh(Vec3(0, 0, 0), Vec3(200, 300, 150))));
  TriangleMesh open = box_mesh(Vec3(0, 0, 0), Vec3(200, 300, 150));
  open.triangles.pop_back();
  const auto gaping = scratch.write("gaping.stl", stl_text(open)).string();
  const auto hollow = scratch.write("hollow.stl", "solid a\nendsolid a\n").string();
  const auto text = scratch.write("words.txt", "1 2\n3 four\n").string();
  scratch.write("ground.txt", "0.2 0.1 0.0\n0.2 0.1 0.0\n");
  const std::string ball = "[[fluid.region]]\nshape = \"sphere\"\ncentre_m = [0.3, 0.25, 0.3]\nradius_m = 0.1\n";
  Rejection r = GetParam();
  for (std::string& set : r.set)
    for (const auto& [word, file] : {std::pair{std::string("GAPING"), gaping}, std::pair{std::string("HOLLOW"), hollow},
                                     std::pair{std::string("WORDS"), text}})
      if (const auto at = set.find(word); at != std::string::npos) set.replace(at, word.size(), "'" + file + "'");
  const auto scene = scratch.write("scene.toml", tank + region + ball + block + ground);
  ASSERT_EQ(mistakes_in(scene).size(), 0u) << testing::PrintToString(mistakes_in(scene));
  expect_rejection(scene, r);
}

INSTANTIATE_TEST_SUITE_P(
    LoadShapes, WrongShape,
    testing::Values(Rejection{{"wall[0].file=''"}, "wall[0].file", "expected the name of a file"},
                    Rejection{{"wall[0].file='missing.stl'"}, "wall[0].file", "there is no such file, expected"},
                    Rejection{{"wall[0].file=GAPING"}, "wall[0].file", "is not closed: 3 edges"},
                    Rejection{{"wall[0].file=HOLLOW"}, "wall[0].file", "has no triangles"},
                    Rejection{{"wall[0].file=WORDS"}, "wall[0].file", "expected .stl, .ply or .obj"},
                    Rejection{{"wall[0].file=7"}, "wall[0].file", "is a whole number"},
                    Rejection{{"wall[0].scale=0"}, "wall[0].scale", "above 0"},
                    Rejection{{"wall[0].translate_m=[1]"}, "wall[0].translate_m", "has 1 entries"},
                    Rejection{{"wall[0].translate_m=[5, 0, 0]"}, "wall[0].file", "lies outside the domain"},
                    Rejection{{"wall[0].resolution_m=-1"}, "wall[0].resolution_m", "at least 0"},
                    Rejection{{"wall[0].resolution_m=1e-6"}, "wall[0].file", "expected a coarser resolution_m"},
                    Rejection{{"wall[0].resolution_m=0.5"}, "wall[0].file", "expected a resolution_m below that"},
                    Rejection{{"wall[0].spacing_m=1"}, "wall[0].spacing_m", "expected only with shape = \"heightmap\""},
                    Rejection{{"wall[0].radius_m=1"}, "wall[0].radius_m", "expected only with"},
                    Rejection{{"wall[1].file=WORDS"}, "wall[1].file", "line 2: \"four\" is no finite number"},
                    Rejection{{"wall[1].spacing_m=0"}, "wall[1].file", "expected spacing_m above 0"},
                    Rejection{{"wall[1].spacing_m=-1"}, "wall[1].spacing_m", "at least 0"},
                    Rejection{{"wall[1].translate_m=[0, 0, 9]"}, "wall[1].file", "has heights from 9 to 9.2 m"},
                    Rejection{{"wall[1].translate_m=[70, 0, 0]"}, "wall[1].file", "covers x from 69.75 to 71.25 m"},
                    Rejection{{"wall[1].translate_m=[0, -2, 0]"}, "wall[1].file", "expected some of the domain"},
                    Rejection{{"fluid.region[1].shape=drop"}, "fluid.region[1].shape", "one of \"box\""},
                    Rejection{{"fluid.region[1].radius_m=0"}, "fluid.region[1].radius_m", "above 0"},
                    Rejection{{"fluid.region[1].radius_m=0.4"}, "fluid.region[1]", "outside the domain"},
                    Rejection{{"fluid.region[1].lower_m=[0, 0, 0]"}, "fluid.region[1].lower_m", "expected only with"}));

}  // namespace
}  // namespace lahar::scene
