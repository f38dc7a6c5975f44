#include "lbm/grid/morton.h"

#include <gtest/gtest.h>

#include <set>

namespace lahar::lbm {
namespace {

TEST(Morton, InterleavesBitsWithXLowest) {
  const std::uint64_t origin = morton_key({0, 0, 0});
  EXPECT_EQ(morton_key({1, 0, 0}) - origin, 1U);
  EXPECT_EQ(morton_key({0, 1, 0}) - origin, 2U);
  EXPECT_EQ(morton_key({0, 0, 1}) - origin, 4U);
  // Bits of x, y, z from the lowest on: 110, 101, 011.
  EXPECT_EQ(morton_key({3, 5, 6}) - origin, 0b110'101'011U);
}

/// Each of the eight blocks of a cube of two comes before the next cube's.
TEST(Morton, CubesAreRuns) {
  std::set<std::uint64_t> keys;
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 2; ++z) keys.insert(morton_key(Vec3i(-4 + x, 6 + y, 2 + z)));
  EXPECT_EQ(keys.size(), 8U);
  EXPECT_EQ(*keys.rbegin() - *keys.begin(), 7U);
}

TEST(Morton, NegativeCoordinatesComeFirst) {
  EXPECT_LT(morton_key({-1, 0, 0}), morton_key({0, 0, 0}));
  EXPECT_LT(morton_key({-1, -1, -1}), morton_key({0, 0, -1}));
  EXPECT_LT(morton_key({-5, 3, 2}), morton_key({5, 3, 2}));
}

}  // namespace
}  // namespace lahar::lbm
