#include "cases/scene/document.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>

#include "cases/scene/writer.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {
namespace {

std::string the_mistake(const std::vector<std::string>& mistakes) {
  return mistakes.size() == 1 ? mistakes[0] : "not one but " + testing::PrintToString(mistakes);
}

TEST(Document, MissingFile) {
  const ScratchFolder scratch;
  EXPECT_EQ(the_mistake(mistakes_in(scratch.path() / "none.toml")),
            "none.toml:0:0: there is no such file, expected a scene (TOML)");
}

TEST(Document, DirectoryInsteadOfFile) {
  const ScratchFolder scratch;
  EXPECT_NE(the_mistake(mistakes_in(scratch.path())).find(":0:0: is a directory, expected a scene file (TOML)"),
            std::string::npos);
}

TEST(Document, DeviceInsteadOfFile) {
  EXPECT_EQ(the_mistake(mistakes_in("/dev/null")), "null:0:0: is no ordinary file, expected a scene file (TOML)");
}

TEST(Document, EmptyFileMissesItsTables) {
  EXPECT_EQ(mistakes_in_text(""),
            (std::vector<std::string>{"scene.toml:1:1: scene.name is missing, expected a string",
                                      "scene.toml:1:1: run.duration_s is missing, expected a number above 0",
                                      "scene.toml:1:1: domain.lower_m is missing, expected three numbers [x, y, z]",
                                      "scene.toml:1:1: domain.upper_m is missing, expected three numbers [x, y, z]",
                                      "scene.toml:1:1: the scene is empty, expected a fluid, grains or a barrier"}));
}

TEST(Document, SyntaxErrorsAreLocated) {
  const std::string text = the_mistake(mistakes_in_text("[scene]\nname = \"x\"\n[run]\nduration_s = = 1\n"));
  EXPECT_TRUE(text.starts_with("scene.toml:4:14: syntax: ")) << text;
  EXPECT_TRUE(text.ends_with(", expected TOML")) << text;
}

TEST(Document, KeyGivenTwice) {
  const std::string text = the_mistake(mistakes_in_text("[run]\nduration_s = 1\nduration_s = 2\n"));
  EXPECT_TRUE(text.starts_with("scene.toml:3:")) << text;
}

TEST(Document, NotUtf8) {
  const std::string text = the_mistake(mistakes_in_text("[scene]\nname = \"\xff\xfe\"\n"));
  EXPECT_TRUE(text.starts_with("scene.toml:2:8: syntax: ")) << text;
}

TEST(Document, TenMegabytesOfNoise) {
  std::string noise(10 << 20, ' ');
  std::uint32_t state = 1;
  for (char& c : noise) {
    state = state * 1664525u + 1013904223u;
    c = static_cast<char>(state >> 24);
  }
  const std::string text = the_mistake(mistakes_in_text(noise));
  EXPECT_TRUE(text.starts_with("scene.toml:1:2: syntax: ")) << text.substr(0, 200);
}

TEST(Document, HugeFile) {
  const ScratchFolder scratch;
  const auto file = scratch.write("huge.toml", "");
  std::filesystem::resize_file(file, std::uintmax_t{4} << 30);  // no byte of it is stored
  EXPECT_EQ(the_mistake(mistakes_in(file)), "huge.toml:0:0: is larger than 16 MiB, expected a scene file (TOML)");
}

/// It may be many times as long as its source, which was accepted.
TEST(Document, AResolvedSceneMayBeFarLonger) {
  const ScratchFolder scratch;
  const std::string text = fmt::format("{}#{}\n", small_scene, std::string(17 << 20, ' '));
  EXPECT_EQ(the_mistake(mistakes_in(scratch.write("long.toml", text))),
            "long.toml:0:0: is larger than 16 MiB, expected a scene file (TOML)");
  const auto resolved = scratch.write("resolved.toml", fmt::format("{}\n{}", resolved_mark, text));
  EXPECT_EQ(load(resolved).identity.name, "small");
  std::filesystem::resize_file(resolved, (std::uintmax_t{256} << 20) + 1);
  EXPECT_EQ(the_mistake(mistakes_in(resolved)),
            "resolved.toml:0:0: is larger than 256 MiB, expected a scene file (TOML)");
}

TEST(Document, DeepNesting) {
  const std::string text = the_mistake(mistakes_in_text(fmt::format("a = {}", std::string(1 << 20, '['))));
  EXPECT_NE(text.find("syntax: "), std::string::npos) << text.substr(0, 200);
}

TEST(Document, LongKeysAreRefused) {
  const auto repeated = [](const std::string& text, int times) {
    std::string all;
    for (int k = 0; k < times; ++k) all += text;
    return all;
  };
  const std::string expected = "a key has more than 64 parts, expected a key of a scene";
  const auto refused = [&](const std::string& text) { return the_mistake(mistakes_in_text(text)); };
  EXPECT_EQ(refused(fmt::format("[scene]\n  {}a = 1\n", repeated("a.", 100000))), "scene.toml:2:3: " + expected);
  EXPECT_EQ(refused(fmt::format("[{}a]\n", repeated("a . ", 1000000))), "scene.toml:1:2: " + expected);
  EXPECT_EQ(refused(fmt::format("x = {{{}a = 1}}\n", repeated("'a'.", 100))), "scene.toml:1:6: " + expected);
  EXPECT_NE(refused(fmt::format("[{}]\n", repeated(".", 1000000))).find("syntax: "), std::string::npos);
  // Dots that are no keys.
  for (const std::string& mistake :
       mistakes_in_text(fmt::format("# {}\nx = [{}]\n", repeated("...", 100), repeated("1.5, ", 200))))
    EXPECT_EQ(mistake.find("parts"), std::string::npos);
}

TEST(Document, BaseFillsWhatIsLeftOpenAndListsAreReplaced) {
  const ScratchFolder scratch;
  scratch.write("base.toml", small_scene);
  scratch.write("middle.toml", "[scene]\nbase = \"base.toml\"\nname = \"middle\"\n[run]\nseed = 5\n");
  const auto top = scratch.write("top.toml", R"([scene]
base = "middle.toml"
title = "top"
[run]
duration_s = 9
[[grains.sphere]]
position_m = [0.1, 0.2, 0.3]
diameter_m = 0.05
density_kg_m3 = 1000
material = "rock"
)");
  const Scene scene = load(top);
  EXPECT_EQ(scene.identity.name, "middle");
  EXPECT_EQ(scene.identity.title, "top");
  EXPECT_FALSE(scene.identity.base.has_value());
  EXPECT_EQ(scene.run.duration, 9);
  EXPECT_EQ(scene.run.seed, 5);
  EXPECT_EQ(scene.domain.upper, Vec3(1, 1, 1));
  ASSERT_EQ(scene.grains.spheres.size(), 1u);
  EXPECT_EQ(scene.grains.spheres[0].position, Vec3(0.1, 0.2, 0.3));
}

TEST(Document, MistakesInABaseAreLocatedThere) {
  const ScratchFolder scratch;
  std::string base = small_scene;
  base.replace(base.find("duration_s = 1.0"), 16, "duration_s = \"x\"");
  scratch.write("base.toml", base);
  const auto top = scratch.write("top.toml", "[scene]\nbase = \"base.toml\"\n[run]\nsede = 3\n");
  const auto all = mistakes_in(top);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0], "base.toml:4:14: run.duration_s is a string, expected a number above 0");
  EXPECT_TRUE(all[1].starts_with("top.toml:4:1: unknown key \"sede\" in [run] (did you mean \"seed\"?)")) << all[1];
}

TEST(Document, BasesThatAreNotThereOrLeadRound) {
  const ScratchFolder scratch;
  const auto lost = scratch.write("lost.toml", "[scene]\nbase = \"nowhere.toml\"\n");
  EXPECT_TRUE(the_mistake(mistakes_in(lost)).starts_with("lost.toml:2:8: scene.base is"));
  const auto long_name = scratch.write("long.toml", "[scene]\nbase = \"" + std::string(300, 'a') + "\"\n");
  EXPECT_TRUE(the_mistake(mistakes_in(long_name)).starts_with("long.toml:2:8: scene.base is"));
  const auto loop = scratch.write("loop.toml", "[scene]\nbase = \"loop.toml\"\n");
  EXPECT_EQ(the_mistake(mistakes_in(loop)), "loop.toml:2:8: scene.base: expected a chain of at most 8");
  const auto number = scratch.write("number.toml", small_scene + "[gravity]\n");
  for (const std::string key : {"base", "changes"})
    EXPECT_EQ(the_mistake(mistakes_in(number, {"scene." + key + "=3"})),
              "--set scene." + key + "=3:1:1: comes after bases are read, expected scene." + key +
                  " as a key of a scene file");
  EXPECT_EQ(
      the_mistake(mistakes_in(number, {"scene={base=\"a.toml\"}"})),
      "--set scene={base=\"a.toml\"}:1:1: comes after bases are read, expected scene.base as a key of a scene file");
}

constexpr const char* kBase = R"([scene]
name = "base"
[run]
duration_s = 1.0
[domain]
lower_m = [0, 0, 0]
upper_m = [1, 1, 1]
[[wall]]
name = "floor"
shape = "plane"
point_m = [0, 0, 0]
normal = [0, 0, 1]
[[wall]]
name = "side"
shape = "plane"
point_m = [0, 1, 0]
normal = [0, -1, 0]
[fluid]
enabled = true
cell_size_m = 0.1
[[fluid.region]]
lower_m = [0, 0, 0]
upper_m = [1, 1, 0.5]
)";

/// A part of a list of the base changes; the rest of the list stays. Bases in between change it first.
TEST(Document, ChangesPartsOfListsOfTheBase) {
  const ScratchFolder scratch;
  scratch.write("base.toml", kBase);
  scratch.write("middle.toml",
                "[scene]\nbase = \"base.toml\"\nname = \"m\"\nchanges = [\"wall[side].slip = free_slip\", "
                "\"fluid.region[0].upper_m = [1, 1, 0.4]\"]\n");
  const auto top = scratch.write(
      "top.toml", "[scene]\nbase = \"middle.toml\"\nname = \"t\"\nchanges = [\"wall[floor].slip = free_slip\"]\n");
  const Scene scene = load(top);
  ASSERT_EQ(scene.walls.size(), 2u);
  EXPECT_EQ(scene.walls[0].slip, WallSlip::free_slip);
  EXPECT_EQ(scene.walls[1].slip, WallSlip::free_slip);
  EXPECT_EQ(scene.walls[1].point, Vec3(0, 1, 0));
  EXPECT_EQ(scene.fluid.regions[0].upper.z(), 0.4);
  EXPECT_TRUE(scene.identity.changes.empty());
}

TEST(Document, WrongChangesAreLocated) {
  const ScratchFolder scratch;
  scratch.write("base.toml", kBase);
  const auto mistakes_of = [&](const std::string& changes, const std::string& base = "base = \"base.toml\"\n") {
    return mistakes_in(scratch.write("top.toml", "[scene]\n" + base + "name = \"t\"\nchanges = " + changes + "\n"));
  };
  EXPECT_EQ(
      the_mistake(mistakes_of("[\"wall[roof].slip = free_slip\"]")),
      "top.toml:4:12: scene.changes \"wall[roof].slip = free_slip\" no entry of the list is named \"roof\", expected "
      "one of floor, side");
  const std::string value = the_mistake(mistakes_of("[\"wall[floor].slip = slippery\"]"));
  EXPECT_NE(value.find("top.toml:4:12: scene.changes: wall[floor].slip = slippery"), std::string::npos) << value;
  EXPECT_NE(value.find("wall[0].slip is \"slippery\""), std::string::npos) << value;
  const auto alone = mistakes_of("[\"wall[floor].slip = free_slip\"]", "");
  ASSERT_FALSE(alone.empty());
  EXPECT_NE(testing::PrintToString(alone).find("top.toml:3:11: scene.changes without scene.base"), std::string::npos)
      << testing::PrintToString(alone);
}

/// Whatever stands in the file: escapes of TOML make any character.
TEST(Document, NamesAreOneLineInMistakes) {
  const ScratchFolder scratch;
  const std::string lost = the_mistake(mistakes_in(scratch.write("top.toml", R"([scene]
base = "no\nwhere.toml"
)")));
  EXPECT_TRUE(lost.starts_with("top.toml:2:8: scene.base is \"")) << lost;
  EXPECT_TRUE(lost.ends_with(R"(/no\u000Awhere.toml", which is no file: expected a scene file)")) << lost;
  scratch.write("base.toml", kBase);
  const std::string changed = the_mistake(mistakes_in(scratch.write("top.toml", R"([scene]
base = "base.toml"
changes = ["wall[floor].slip = '\u001B[31m'"]
)")));
  EXPECT_TRUE(changed.starts_with(R"(top.toml:3:12: scene.changes "wall[floor].slip = '\u001B[31m'" )")) << changed;
  EXPECT_EQ(changed.find('\x1b'), std::string::npos) << changed;
  const std::string twice = the_mistake(mistakes_in_text("\"a\xc2\x9b\" = 1\n\"a\xc2\x9b\" = 2\n"));
  EXPECT_TRUE(twice.starts_with("scene.toml:2:")) << twice;
  EXPECT_NE(twice.find(R"(a\u009B)"), std::string::npos) << twice;
  EXPECT_EQ(twice.find("\xc2\x9b"), std::string::npos) << twice;
}

}  // namespace
}  // namespace lahar::scene
