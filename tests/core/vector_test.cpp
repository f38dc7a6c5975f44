#include "core/vector.h"

#include <gtest/gtest.h>

namespace lahar {
namespace {

TEST(Vec3Field, ReadsBackWhatWasWritten) {
  Vec3Field f;
  f.push_back({1, 2, 3});
  f.push_back({4, 5, 6});
  ASSERT_EQ(f.size(), 2u);
  EXPECT_EQ(f[0], Vec3(1, 2, 3));
  f.set(0, {7, 8, 9});
  f.add(1, {0.5, -0.5, 1});
  EXPECT_EQ(f[0], Vec3(7, 8, 9));
  EXPECT_EQ(f[1], Vec3(4.5, 4.5, 7));
}

TEST(Vec3Field, FillKeepsTheSizeAndResizeFillsWithZero) {
  Vec3Field f;
  f.resize(3);
  EXPECT_EQ(f[2], Vec3(0, 0, 0));
  f.fill({1, -2, 3});
  ASSERT_EQ(f.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(f[i], Vec3(1, -2, 3));
}

TEST(Vec3Field, EachComponentIsContiguous) {
  Vec3Field f;
  for (int i = 0; i < 4; ++i) f.push_back({1.0 * i, 10.0 * i, 100.0 * i});
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(f.x.data()[i], 1.0 * i);
    EXPECT_EQ(f.y.data()[i], 10.0 * i);
    EXPECT_EQ(f.z.data()[i], 100.0 * i);
  }
}

}  // namespace
}  // namespace lahar
