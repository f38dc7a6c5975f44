#include "cases/scene/range.h"

#include <gtest/gtest.h>

namespace lahar::scene {
namespace {

TEST(Range, BoundsAreInsideUnlessOpen) {
  EXPECT_FALSE(positive().contains(0));
  EXPECT_TRUE(positive().contains(1e-300));
  EXPECT_TRUE(non_negative().contains(0));
  EXPECT_FALSE(non_negative().contains(-1e-300));
  EXPECT_TRUE(between(0, 0.5).contains(0.5));
  EXPECT_FALSE(between(0, 0.5).contains(0.5001));
  EXPECT_TRUE(above_up_to(0, 1).contains(1));
  EXPECT_FALSE(above_up_to(0, 1).contains(0));
  EXPECT_TRUE(Range{}.contains(-1e300));
}

TEST(Range, SaysWhatItAllows) {
  EXPECT_EQ(positive().text(), "above 0");
  EXPECT_EQ(at_least(8).text(), "at least 8");
  EXPECT_EQ(between(0, 0.5).text(), "from 0 to 0.5");
  EXPECT_EQ(above_up_to(0, 1).text(), "above 0 and at most 1");
  EXPECT_EQ(Range{}.text(), "");
}

}  // namespace
}  // namespace lahar::scene
