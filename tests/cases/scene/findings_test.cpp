#include "cases/scene/findings.h"

#include <gtest/gtest.h>

#include <ctime>

namespace lahar::scene {
namespace {

TEST(Findings, FallsBackToTheNearestPlaceAround) {
  Findings findings("f.toml");
  findings.locate("a.b", {"f.toml", 3, 4});
  EXPECT_EQ(findings.place("a.b.c[2].d"), (Place{"f.toml", 3, 4}));
  EXPECT_EQ(findings.place("a.x"), (Place{"f.toml", 1, 1}));
}

TEST(Findings, SoundnessSpreadsInwardsAndOutwards) {
  Findings findings("f.toml");
  findings.mistake("a.b[1].c", "wrong");
  EXPECT_FALSE(findings.sound({"a.b[1].c"}));
  EXPECT_FALSE(findings.sound({"a.b[1]"}));
  EXPECT_FALSE(findings.sound({"x", "a"}));
  EXPECT_FALSE(findings.sound({"a.b[1].c.d"}));
  EXPECT_TRUE(findings.sound({"a.b[10]", "a.b[0]", "a.bb"}));
}

/// Signs that stand before '.' and '[' in the order of characters part a table from what is inside it.
TEST(Findings, NamesThatBeginAlikeAreNotInside) {
  Findings findings("f.toml");
  findings.mistake("a.b-c.d", "wrong");
  findings.mistake("a.b0", "wrong");
  EXPECT_TRUE(findings.sound({"a.b"}));
  findings.not_read("a.b.c");
  EXPECT_FALSE(findings.sound({"a.b"}));
  EXPECT_TRUE(findings.sound({"a.b.cc", "a.b[0]"}));
}

/// A name that is mistyped once stands in as many mistakes as there are grains: none is looked at to judge another
/// grain. Mistake by mistake this takes 4e8 comparisons.
TEST(Findings, ManyMistakesAreLookedUp) {
  Findings findings("f.toml");
  constexpr int many = 20'000;
  const auto path = [](int k) { return "grains.sphere[" + std::to_string(k) + "]"; };
  for (int k = 0; k < many; ++k) findings.mistake(path(k) + ".material", "wrong");
  const std::clock_t start = std::clock();
  for (int k = 0; k < many; ++k) EXPECT_TRUE(findings.sound({path(many + k)}));
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 1);
}

/// What the user changed is to blame, then what is written, then the table around.
TEST(Findings, AMistakeOfSeveralValuesStandsAtTheOneThatWasChanged) {
  const auto place_of_mistake = [](const std::vector<std::pair<std::string, Place>>& written) {
    Findings findings("f.toml");
    for (const auto& [path, place] : written) findings.locate(path, place);
    findings.mistake("a.x", "wrong", {"a.y", "b.z"});
    EXPECT_FALSE(findings.sound({"a.x"}));
    EXPECT_TRUE(findings.sound({"a.y"}));
    const InputMistake m = findings.mistakes().at(0);
    return Place{m.file, m.line, m.column};
  };
  const std::pair<std::string, Place> own{"a.x", {"f.toml", 3, 1}}, other{"b.z", {"f.toml", 9, 1}},
      table{"a", {"f.toml", 2, 1}};
  const std::pair<std::string, Place> changed{"b.z", {"--set b.z=1", 1, 1}};
  EXPECT_EQ(place_of_mistake({table, own, changed}), changed.second);
  EXPECT_EQ(place_of_mistake({table, own, other}), own.second);
  EXPECT_EQ(place_of_mistake({table, other}), other.second);
  EXPECT_EQ(place_of_mistake({table}), table.second);
}

TEST(Findings, SortsByPlace) {
  Findings findings("f.toml");
  findings.mistake_at({"f.toml", 10, 1}, "late");
  findings.mistake_at({"f.toml", 9, 5}, "early");
  ASSERT_EQ(findings.mistakes().size(), 2u);
  EXPECT_EQ(findings.mistakes()[0].message, "early");
}

}  // namespace
}  // namespace lahar::scene
