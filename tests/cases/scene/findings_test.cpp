#include "cases/scene/findings.h"

#include <gtest/gtest.h>

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

TEST(Findings, SortsByPlace) {
  Findings findings("f.toml");
  findings.mistake_at({"f.toml", 10, 1}, "late");
  findings.mistake_at({"f.toml", 9, 5}, "early");
  ASSERT_EQ(findings.mistakes().size(), 2u);
  EXPECT_EQ(findings.mistakes()[0].message, "early");
}

}  // namespace
}  // namespace lahar::scene
