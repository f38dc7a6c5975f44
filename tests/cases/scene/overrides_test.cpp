#include "cases/scene/overrides.h"

#include <gtest/gtest.h>

#include "cases/scene/one_line.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {
namespace {

std::string dotted(int parts, const std::string& part) {
  std::string key = part;
  for (int k = 1; k < parts; ++k) key += "." + part;
  return key;
}

TEST(ParsePath, SplitsKeysAndIndices) {
  const std::vector<PathStep> path = parse_path("grains.packing[0].sizes[12].count");
  ASSERT_EQ(path.size(), 6u);
  EXPECT_EQ(path[1].key, "packing");
  EXPECT_TRUE(path[2].key.empty());
  EXPECT_EQ(path[4].index, 12u);
  EXPECT_EQ(path[5].key, "count");
}

TEST(ParsePath, TakesNamesOfEntries) {
  const std::vector<PathStep> path = parse_path("wall[left_side].point_m");
  ASSERT_EQ(path.size(), 3u);
  EXPECT_EQ(path[1].name, "left_side");
  EXPECT_TRUE(path[1].key.empty());
}

TEST(ParsePath, RefusesWhatIsNoPath) {
  for (const char* text :
       {"", ".", "a.", ".a", "a..b", "a[", "a[]", "a[x y]", "a[x", "a[1", "a[-1]", "[0]", "a b", "a[0]b"})
    EXPECT_TRUE(parse_path(text).empty()) << text;
}

TEST(Overrides, ChangeNumbersWordsListsAndNestedTables) {
  const Scene scene =
      load(case_file("debris_flow/scene.toml"),
           {"run.duration_s=2", "run.precision=double", "fluid.collision = \"trt\"", "domain.upper_m=[6, 1.8, 2]",
            "grains.packing[0].sizes[1].count=7", "wall[0].slip=free_slip", "coupling.wire_drag=false",
            "materials.rock.youngs_modulus_Pa=1e9"});
  EXPECT_EQ(scene.run.duration, 2);
  EXPECT_EQ(scene.run.precision, Precision::float64);
  EXPECT_EQ(scene.fluid.collision, CollisionOperator{lbm::Trt{}});
  EXPECT_EQ(scene.domain.upper, Vec3(6, 1.8, 2));
  EXPECT_EQ(scene.grains.packings[0].sizes[1].count, 7);
  EXPECT_EQ(scene.walls[0].slip, WallSlip::free_slip);
  EXPECT_FALSE(scene.coupling.wire_drag);
  EXPECT_EQ(scene.materials[0].youngs_modulus, 1e9);
}

TEST(Overrides, FindEntriesByName) {
  const Scene scene = load(case_file("dam_break/scene.toml"), {"wall[far_side].slip=no_slip"});
  EXPECT_EQ(scene.walls[0].slip, WallSlip::free_slip);
  EXPECT_EQ(scene.walls[1].slip, WallSlip::no_slip);
  const auto wrong = mistakes_in(case_file("dam_break/scene.toml"), {"wall[far].slip=no_slip", "probe[end_wall]=3"});
  ASSERT_EQ(wrong.size(), 2u);
  EXPECT_NE(wrong[1].find("no entry of the list is named \"far\", expected one of near_side, far_side"),
            std::string::npos)
      << wrong[1];
  EXPECT_NE(wrong[0].find("replaces entry [end_wall], expected a key of it"), std::string::npos) << wrong[0];
}

TEST(Overrides, LaterOnesWin) {
  EXPECT_EQ(load_text(small_scene, {"run.duration_s=2", "run.duration_s=3"}).run.duration, 3);
}

TEST(Overrides, MakeTablesAndAppendToLists) {
  const Scene scene = load_text(small_scene, {"gravity.slope_deg=10", "grains.sphere[1].position_m=[0.2, 0.2, 0.2]",
                                              "grains.sphere[1].diameter_m=0.1", "grains.sphere[1].density_kg_m3=1",
                                              "grains.sphere[1].material=rock"});
  EXPECT_EQ(scene.gravity.slope_deg, 10);
  ASSERT_EQ(scene.grains.spheres.size(), 2u);
  EXPECT_EQ(scene.grains.spheres[1].position, Vec3(0.2, 0.2, 0.2));
}

TEST(Overrides, WrongValuesAreLocatedAtTheOverride) {
  EXPECT_EQ(mistakes_in_text(small_scene, {"run.duration_s=-1"}),
            std::vector<std::string>{"--set run.duration_s=-1:1:1: run.duration_s is -1, expected a number above 0"});
  const auto unknown = mistakes_in_text(small_scene, {"run.durtaion_s=1"});
  ASSERT_EQ(unknown.size(), 1u);
  EXPECT_TRUE(
      unknown[0].starts_with("--set run.durtaion_s=1:1:1: unknown key \"durtaion_s\" in [run] (did you mean "
                             "\"duration_s\"?)"))
      << unknown[0];
}

/// Lists are read whole: an entry that one changes moves their place to it.
TEST(Overrides, WrongEntriesOfListsAreLocatedAtTheOverride) {
  for (const std::string text : {"domain.upper_m[3]=1", "domain.upper_m[1]=up", "domain.upper_m[2]=-1"}) {
    const auto mistakes = mistakes_in_text(small_scene, {text});
    ASSERT_EQ(mistakes.size(), 1u) << text;
    EXPECT_TRUE(mistakes[0].starts_with("--set " + text + ":1:1: domain.upper_m")) << mistakes[0];
  }
  const Scene scene = load_text(small_scene, {"domain.upper_m[1]=3", "grains.sphere[0].position_m[2]=0.25"});
  EXPECT_EQ(scene.domain.upper, Vec3(1, 3, 1));
  EXPECT_EQ(scene.grains.spheres[0].position, Vec3(0.5, 0.5, 0.25));
}

TEST(Overrides, WhatATableThatOneMakesLacksIsLocatedAtIt) {
  const auto mistakes = mistakes_in_text(small_scene, {"grains.sphere[1].diameter_m=0.1"});
  ASSERT_FALSE(mistakes.empty());
  for (const std::string& m : mistakes)
    EXPECT_TRUE(m.starts_with("--set grains.sphere[1].diameter_m=0.1:1:1: grains.sphere[1]")) << m;
}

TEST(Overrides, WhatANamedTableThatOneMakesLacksIsLocatedAtIt) {
  const auto mistakes = mistakes_in(case_file("bouncing_sphere/scene.toml"), {"materials.stele.youngs_modulus_Pa=1e9"});
  ASSERT_EQ(mistakes.size(), 1u);
  EXPECT_TRUE(mistakes[0].starts_with(
      "--set materials.stele.youngs_modulus_Pa=1e9:1:1: materials.stele.poisson_ratio is missing"))
      << mistakes[0];
}

TEST(Overrides, TextsOfSeveralWordsNeedQuotes) {
  const auto mistakes = mistakes_in(case_file("bouncing_sphere/scene.toml"), {"scene.title=My title"});
  ASSERT_EQ(mistakes.size(), 1u);
  EXPECT_NE(mistakes[0].find("a text of several words needs quotes"), std::string::npos) << mistakes[0];
  EXPECT_TRUE(mistakes_in(case_file("bouncing_sphere/scene.toml"), {"scene.title=\"My title\""}).empty());
}

TEST(Overrides, PathsNeedNoQuotes) {
  for (const std::string path : {"a.stl", "shapes/a-1.stl", "./a.stl", "../shapes/a.stl", "/shapes/a.stl"}) {
    const Scene scene = load(case_file("dam_break/scene.toml"), {"scene.title=" + path});
    EXPECT_EQ(scene.identity.title, path);
  }
  for (const std::string value : {"1.5.2", "1,5", "a b.stl", "."})
    EXPECT_EQ(mistakes_in_text(small_scene, {"scene.title=" + value}).size(), 1U) << value;
}

TEST(Overrides, NumbersTooLargeAreNoWords) {
  const auto all = mistakes_in_text(small_scene, {"run.seed=99999999999999999999"});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NE(all[0].find("\"99999999999999999999\" is no TOML value"), std::string::npos) << all[0];
}

TEST(Overrides, LongKeysAreRefused) {
  std::string key = "a";
  for (int k = 0; k < 50000; ++k) key += ".a";
  for (const std::string& text : {key + "=1", "run.duration_s={" + key + "=1}"}) {
    const auto all = mistakes_in_text(small_scene, {text});
    ASSERT_EQ(all.size(), 1u);
    EXPECT_NE(all[0].find("a key of more than 64 parts"), std::string::npos);
  }
}

/// Parts in quotes may hold whatever ends a word.
TEST(Overrides, LongKeysInQuotesAreRefused) {
  for (const std::string part : {R"("/")", "'='", R"("a b")", R"("\"")", R"("")", "'#'", R"("[" )"}) {
    const auto all = mistakes_in_text(small_scene, {"run.duration_s={" + dotted(50000, part) + "=1}"});
    ASSERT_EQ(all.size(), 1u) << part;
    EXPECT_NE(all[0].find("a key of more than 64 parts"), std::string::npos) << part;
  }
}

TEST(FindLongKey, CountsWordsAndQuotes) {
  EXPECT_EQ(find_long_key(dotted(64, "a") + " = 1"), std::string::npos);
  EXPECT_EQ(find_long_key("b = 1\n" + dotted(65, "a")), 6U);
  EXPECT_EQ(find_long_key("b = 1\n[" + dotted(65, "'.'")), 7U);
  EXPECT_EQ(find_long_key(dotted(64, "'/'") + " = 1"), std::string::npos);
}

/// What looks like the begin of a string in a comment or in another string is none: no key hides behind it.
TEST(FindLongKey, KnowsWhereStringsEnd) {
  const std::string key = dotted(65, R"("/")"), words = dotted(65, "a");
  for (const std::string before : {"# it's\n", "a = \"it's\"\n", "a = 'say \"'\n", "a = \"\\\"'\"\n", "a = '\\'\n",
                                   "a = \"\"\n", "a = \"\"\"one \" \"\" quote'\n\"\"\"\"\"\n", "a = '''\\\n''''\n",
                                   "a = \"\"\"\\\"\"\"\"\n", "a = \"\"\"\"\"\"\n"})
    EXPECT_EQ(find_long_key(before + key), before.size()) << before;
  for (const std::string& text : {"# " + words + "\n", "a = \"" + words + "\"\n", "a = \"\"\"\n" + words + "\"\"\"\n",
                                  "a = '" + words + "'", "a = \"" + words})
    EXPECT_EQ(find_long_key(text), std::string::npos) << text;
}

TEST(Overrides, AreOneLineInMessages) {
  for (const std::string text :
       {"run.duration_s=\"a\nb\"", "run.\x1b[31m=1", "scene.nam\n=1", "run.duration_s=\x1b[31m"}) {
    const auto all = mistakes_in_text(small_scene, {text});
    ASSERT_EQ(all.size(), 1U) << text;
    EXPECT_EQ(all[0].find_first_of("\n\x1b"), std::string::npos) << all[0];
    EXPECT_TRUE(all[0].starts_with("--set " + on_one_line(text))) << all[0];
  }
  EXPECT_EQ(on_one_line("a\tb\x7f\\\""), R"(a\u0009b\u007F\")");
}

/// In UTF-8, where 0xC2 0x9B, say, begins commands to a terminal as ESC [ does.
TEST(Overrides, ControlCharactersOfTwoBytesAreWrittenOut) {
  EXPECT_EQ(on_one_line("\xc2\x80 \xc2\x85 \xc2\x9b[31m \xc2\x9f"), R"(\u0080 \u0085 \u009B[31m \u009F)");
  // U+00A0, letters whose last byte is one of those, and what is no UTF-8.
  for (const std::string text : {"\xc2\xa0", "\xc3\x9b", "\xe2\x82\x9b", "\xc2", "\x9b", "\xc2z"})
    EXPECT_EQ(on_one_line(text), text);
}

TEST(Overrides, SenselessOnesAreAllReported) {
  const auto all = mistakes_in_text(small_scene, {"run.duration_s", "=1", "run.duration_s=[1", "run.duration_s.x=1",
                                                  "grains.sphere[5].fixed=true", "run[0]=1", "run.seed=1\nx=2"});
  ASSERT_EQ(all.size(), 7u);
  const std::string joined = testing::PrintToString(all);
  for (const char* part : {"has no \"=\"", "is no key path", "is no TOML value", "inside a number", "past the end",
                           "index [0] into a table", "has a line break"})
    EXPECT_NE(joined.find(testing::PrintToString(std::string(part)).substr(1, 8)), std::string::npos) << part << joined;
}

}  // namespace
}  // namespace lahar::scene
