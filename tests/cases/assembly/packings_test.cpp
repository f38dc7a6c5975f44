#include "cases/assembly/packings.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cases/assembly/build.h"
#include "cases/assembly/check_start.h"
#include "core/check.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

/// 120 beads of 4 cm in two packings of 0.2 m x 0.2 m: at the densest they stand 0.067 m high less what the rough
/// surface leaves open.
scene::Scene two_packings(const std::string& target, const std::string& more = "") {
  const std::string packing = R"(
[[grains.packing]]
lower_m = [0.0, LOW, 0.0]
upper_m = [0.2, HIGH, 0.5]
target_height_m = TARGET
[[grains.packing.sizes]]
diameter_m = 0.04
count = 60
density_kg_m3 = 2500.0
material = "rock"
)";
  std::string text(scene::small_scene);
  for (const auto& [low, high] : {std::pair{"0.0", "0.2"}, std::pair{"0.4", "0.6"}}) {
    std::string one = packing;
    one.replace(one.find("LOW"), 3, low);
    one.replace(one.find("HIGH"), 4, high);
    one.replace(one.find("TARGET"), 6, low == std::string("0.4") ? target : "0.0");
    text += one;
  }
  return scene::load_text(text + more);
}

TEST(Packings, AMissedHeightIsTold) {
  const scene::Scene low = two_packings("0.05"), high = two_packings("0.2");
  const BuiltSolids built = build_solids(low);
  const std::vector<std::string> missed = missed_heights(low, built.solids.particles());
  ASSERT_EQ(missed.size(), 1u);
  EXPECT_TRUE(missed[0].starts_with("grains.packing[1] stands 0.0")) << missed[0];
  EXPECT_TRUE(missed[0].ends_with(" m high, above its target_height_m of 0.05")) << missed[0];
  EXPECT_TRUE(missed_heights(high, build_solids(high).solids.particles()).empty());
}

/// Single grains stand out of the height that a packing has in the mean.
TEST(Packings, ASphereAmongTheirTopGrainsIsRefused) {
  const auto with_sphere = [](const char* z) {
    return two_packings("0.05", std::string(R"([[grains.sphere]]
diameter_m = 0.04
density_kg_m3 = 2500.0
material = "rock"
position_m = [0.1, 0.5, )") + z + "]\n");
  };
  EXPECT_NO_THROW(build_solids(with_sphere("0.15")));
  try {
    build_solids(with_sphere("0.07"));
    FAIL() << "it begins inside the packing";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("grains.sphere[1] reaches into a packed grain"), std::string::npos)
        << e.what();
    EXPECT_GT(e.mistakes().front().line, 1) << "the place of the sphere";
  }
}

/// A large grain stands out of the top of its box, into the small ones of the box above, with which it shares no space.
TEST(Packings, GrainsThatStandOutIntoThePackingAboveAreRefused) {
  const std::string sizes = R"(
[[grains.packing.sizes]]
diameter_m = 0.008
count = 600
density_kg_m3 = 2500.0
material = "rock"
)";
  const auto stacked = [&](const std::string& middle, const std::string& second) {
    return scene::load_text(std::string(scene::small_scene) +
                                "\n[[grains.packing]]\nlower_m = [0.0, 0.0, 0.0]\nupper_m = [0.1, 0.1, " + middle +
                                "]\n" + sizes +
                                "[[grains.packing.sizes]]\ndiameter_m = 0.03\ncount = 3\ndensity_kg_m3 = 2500.0\n"
                                "material = \"rock\"\n[[grains.packing]]\nlower_m = [0.0, 0.0, " +
                                second + "]\nupper_m = [0.1, 0.1, 0.3]\n" + sizes,
                            {"run.seed=2"});
  };
  EXPECT_NO_THROW(build_solids(stacked("0.043", "0.063")));
  try {
    build_solids(stacked("0.043", "0.043"));
    FAIL() << "a grain begins inside another";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("lies in one of grains.packing[0]"), std::string::npos) << e.what();
  }
}

/// A steel sphere 5 % of its radius deep in the floor: W = 8/15 E* sqrt(R) overlap^2.5 throws it at 46 m/s.
TEST(Packings, ABurstAtTheStartIsTold) {
  const auto told = [](const char* z) {
    const scene::Scene scene =
        scene::load(scene::case_file("bouncing_sphere/scene.toml"),
                    {std::string("grains.sphere[0].position_m=[0, 0, ") + z + "]", "solids.contact_modulus_scale=1"});
    return burst_at_start(build_solids(scene).solids);
  };
  EXPECT_NE(told("0.0475").find("would throw it at up to 46 m/s"), std::string::npos) << told("0.0475");
  EXPECT_EQ(told("0.05"), "");
  EXPECT_EQ(told("0.55"), "");
}

/// A packing settles in its own box. `check` looks where centres of grains may be, ever closer beside walls.
TEST(Packings, WallsInTheirBoxAreRefused) {
  const auto plate = [](const char* z) {
    return std::string(R"([[wall]]
shape = "box"
material = "rock"
lower_m = [-1.0, -1.0, )") +
           z + "\n";
  };
  const auto text = [&](const std::string& low, const std::string& high) {
    return scene::small_scene + plate((low + "]\nupper_m = [2.0, 2.0, " + high + "]").c_str()) + R"([[grains.packing]]
lower_m = [0.0, 0.0, 0.0]
upper_m = [0.2, 0.2, 0.3]
[[grains.packing.sizes]]
diameter_m = 0.04
count = 60
density_kg_m3 = 2500.0
material = "rock"
)";
  };
  for (const char* low :
       {"0.045", "0.0531", "0.1117"}) {  // a plate of a centimetre, between points of a coarse lattice
    const auto mistakes = scene::mistakes_in_text(text(low, std::to_string(std::stod(low) + 0.01)));
    ASSERT_EQ(mistakes.size(), 1U) << low;
    EXPECT_NE(mistakes[0].find("grains.packing[0] reaches"), std::string::npos) << mistakes[0];
    EXPECT_NE(mistakes[0].find("into wall[0]"), std::string::npos) << mistakes[0];
  }
  EXPECT_TRUE(scene::mistakes_in_text(text("-1.0", "0.0")).empty()) << "they stand on it";
  const std::string thin = text("0.0531", "0.0532");
  ASSERT_TRUE(scene::mistakes_in_text(thin).empty()) << "thinner than `check` looks";
  try {
    build_solids(scene::load_text(thin));
    FAIL() << "grains stand in the plate";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("grains.packing[0]: a grain at ("), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("reaches into wall[0]"), std::string::npos) << e.what();
    EXPECT_GT(e.mistakes().front().line, 1);
  }
}

TEST(Packings, PlaceholdersAreAsMany) {
  const scene::Scene scene = two_packings("0.2");
  EXPECT_EQ(build_solids(scene, GrainStart::placeholders).solids.particles().size(),
            build_solids(scene).solids.particles().size());
}

}  // namespace
}  // namespace lahar::cases
