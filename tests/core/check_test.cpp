#include "core/check.h"

#include <gtest/gtest.h>

#include <string>

namespace lahar {
namespace {

TEST(InputError, NamesFileLineAndColumn) {
  const InputError e({{"scene.toml", 7, 3, "unknown key 'visocsity', did you mean 'viscosity'?"}});
  EXPECT_STREQ(e.what(), "scene.toml:7:3: unknown key 'visocsity', did you mean 'viscosity'?");
}

TEST(InputError, OneLineForEachMistakeInTheirOrder) {
  const InputError e({{"a.toml", 2, 1, "first"}, {"b.toml", 1, 9, "second"}, {"a.toml", 1, 1, "third"}});
  EXPECT_STREQ(e.what(), "a.toml:2:1: first\nb.toml:1:9: second\na.toml:1:1: third");
  ASSERT_EQ(e.mistakes().size(), 3u);
  EXPECT_EQ(e.mistakes()[1].file, "b.toml");
  EXPECT_EQ(e.mistakes()[1].line, 1);
  EXPECT_EQ(e.mistakes()[1].column, 9);
  EXPECT_EQ(e.mistakes()[1].message, "second");
}

TEST(InputError, AMistakeWithoutAPlaceStillHasTheForm) {
  EXPECT_STREQ(InputError(std::string("no walls")).what(), "input:0:0: no walls");
}

TEST(NumericalFailure, SaysWhereWhenAndWhy) {
  const NumericalFailure e("cell (1, 2, 3)", 1200, "speed 0.41 above 0.3");
  EXPECT_STREQ(e.what(), "cell (1, 2, 3), step 1200: speed 0.41 above 0.3");
  EXPECT_EQ(e.where(), "cell (1, 2, 3)");
  EXPECT_EQ(e.step(), 1200);
  EXPECT_EQ(e.cause(), "speed 0.41 above 0.3");
}

TEST(Require, ThrowsWhenTheInvariantDoesNotHold) {
  EXPECT_NO_THROW(require(true, "never"));
  EXPECT_THROW(require(false, "ring is open"), std::logic_error);
  try {
    require(false, "ring is open");
  } catch (const std::logic_error& e) {
    EXPECT_STREQ(e.what(), "ring is open");
  }
}

}  // namespace
}  // namespace lahar
