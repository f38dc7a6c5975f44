// What a fluid takes of memory, and how much liquid a region becomes.
#include "cases/assembly/memory.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cases/assembly/geometry.h"
#include "cases/runner/check.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // which takes memory of its own
#else
constexpr bool kSanitized = false;
#endif

/// A tank that is as good as full.
const std::string tank = R"([scene]
name = "tank"
[run]
duration_s = 1e-5
checkpoint_wall_s = 0
[domain]
lower_m = [0, 0, 0]
upper_m = [0.48, 0.48, 0.48]
open_faces = ["z+"]
[fluid]
enabled = true
cell_size_m = 0.005
[[fluid.region]]
lower_m = [0, 0, 0]
upper_m = [0.48, 0.48, 0.4]
)";

/// Grains up to two thirds of its depth.
const std::string grains = R"([materials.rock]
youngs_modulus_Pa = 1e7
poisson_ratio = 0.2
[[contact]]
materials = ["rock", "rock"]
friction = 0.5
restitution = 0.5
[coupling]
enabled = true
[[grains.packing]]
lower_m = [0.01, 0.01, 0]
upper_m = [0.47, 0.47, 0.47]
[[grains.packing.sizes]]
diameter_m = 0.04
count = 1000
density_kg_m3 = 2600
material = "rock"
)";

/// bytes, of a run of a step as a process of its own.
double peak_of_run(const std::string& text, const std::string& set) {
  const ScratchFolder folder;
  const std::string out = (folder.path() / "out").string(), scene = folder.write("scene.toml", text).string();
  // The shell stays: what takes its place would count the memory of the test as its own.
  const std::string command =
      "'" LAHAR_EXECUTABLE "' run '" + scene + "' --quiet --out '" + out + "' " + set + "; exit $?";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return nlohmann::json::parse(file_text(out + "/summary.json"))["performance"]["peak_rss_bytes"].get<double>();
}

/// What the program takes by itself and for its grains is left out: a run with coarse cells has that, too.
TEST(Memory, IsWhatARunTakes) {
  if (kSanitized) GTEST_SKIP();
  struct Row {
    std::string text;
    const char* precision;
  };
  for (const Row& row : {Row{tank, "float"}, Row{tank, "double"}, Row{tank + grains, "float"}}) {
    const std::string precision = std::string("run.precision=") + row.precision;
    const double measured = peak_of_run(row.text, "--set " + precision) -
                            peak_of_run(row.text, "--set fluid.cell_size_m=0.04 --set " + precision);
    const double estimated = cases::check_scene(load_text(row.text, {precision})).fluid->start_bytes;
    EXPECT_GT(estimated, 0.95 * measured) << row.precision << ", " << row.text.size();
    EXPECT_LT(estimated, 1.2 * measured) << row.precision << ", " << row.text.size();
  }
}

/// Bodies add their fields where they are, not everywhere; they reach more blocks as they spread.
TEST(Memory, BodiesCountWhereTheyAre) {
  const Scene packed = load_text(tank + grains), dry = load_text(tank);
  EXPECT_EQ(blocks_with_bodies(dry, 1000, 1), 0);
  EXPECT_EQ(blocks_with_bodies(packed, 1000, 1), 1000);
  const double all = blocks_with_bodies(packed, 1e9, 1);
  EXPECT_GT(all, 1000);
  EXPECT_GT(blocks_with_bodies(packed, 1e9, 3), 2 * all);
  Scene alone = packed;
  alone.grains.packings[0].sizes[0].count = 1;
  EXPECT_LT(blocks_with_bodies(alone, 1e9, 3), 20);
  Scene uncoupled = packed;
  uncoupled.coupling.enabled = false;
  EXPECT_EQ(blocks_with_bodies(uncoupled, 1000, 1), 0);
}

/// Walls that stand beside a region and reach into it, of each shape: a sphere by a cap of half its radius.
TEST(Memory, WallsOfEachShapeTakeLiquidAway) {
  const auto share = [](const std::string& wall) {
    const Scene scene = load_text(tank + "[[wall]]\nname = \"solid\"\n" + wall);
    return liquid_of_region(scene, make_walls(scene), 0).share;
  };
  const double box = 0.48 * 0.48 * 0.4, pi = std::numbers::pi, r = 0.2, cap = pi * r * r * r * 5 / 24;
  EXPECT_NEAR(share("shape = \"sphere\"\ncentre_m = [-0.1, 0.24, 0.2]\nradius_m = 0.2\n"), 1 - cap / box, 0.004);
  EXPECT_NEAR(share("shape = \"cylinder\"\nstart_m = [0, 0, -0.1]\nend_m = [0, 0, 0.5]\nradius_m = 0.2\n"),
              1 - pi * r * r / 4 * 0.4 / box, 0.004);
  EXPECT_NEAR(share("shape = \"box\"\nlower_m = [-1, -1, -1]\nupper_m = [0.12, 1, 0.1]\n"), 1 - 0.25 * 0.25, 0.004);
  EXPECT_NEAR(share("shape = \"plane\"\npoint_m = [0.24, 0.24, 0.2]\nnormal = [1, 1, 1]\n"), 0.5, 0.004);
  EXPECT_EQ(share("shape = \"plane\"\npoint_m = [0, 0, 0]\nnormal = [0, 0, 1]\n"), 1);
}

/// Of many walls those that a region meets are looked at.
TEST(Memory, FarWallsTakeNoTime) {
  const auto seconds = [](int far_walls) {  // of the processor
    std::string text = tank + "[[wall]]\nshape = \"box\"\nlower_m = [-1, -1, -1]\nupper_m = [0.1, 0.1, 0.1]\n";
    for (int k = 0; k < far_walls; ++k)
      text += "[[wall]]\nshape = \"box\"\nlower_m = [-1, -1, 0.41]\nupper_m = [0.05, 0.05, 0.42]\n";
    const Scene scene = load_text(text);
    const std::clock_t start = std::clock();
    for (int k = 0; k < 5; ++k) EXPECT_LT(liquid_cells(scene), 96 * 96 * 80);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  EXPECT_LT(seconds(200), 10 * seconds(0));
}

}  // namespace
}  // namespace lahar::scene
