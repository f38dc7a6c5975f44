#include "lbm/grid/morton.h"

#include <gtest/gtest.h>

#include <set>

namespace lahar::lbm {
namespace {

TEST(Morton, BlocksOfATileGoRowByRow) {
  const std::uint64_t origin = morton_key({0, 0, 0});
  EXPECT_EQ(morton_key({0, 0, 1}) - origin, 1U);
  EXPECT_EQ(morton_key({0, 1, 0}) - origin, 4U);
  EXPECT_EQ(morton_key({1, 0, 0}) - origin, 16U);
  EXPECT_EQ(morton_key({3, 3, 3}) - origin, 63U);
}

TEST(Morton, InterleavesBitsOfTilesWithXLowest) {
  const std::uint64_t origin = morton_key({0, 0, 0});
  EXPECT_EQ(morton_key({4, 0, 0}) - origin, 64U);
  EXPECT_EQ(morton_key({0, 4, 0}) - origin, 2 * 64U);
  EXPECT_EQ(morton_key({0, 0, 4}) - origin, 4 * 64U);
  // Bits of x, y, z of the tile from the lowest on: 110, 101, 011.
  EXPECT_EQ(morton_key({4 * 3, 4 * 5, 4 * 6}) - origin, 64 * 0b110'101'011U);
}

/// Each of the blocks of a cube of eight comes before the next cube's.
TEST(Morton, CubesAreRuns) {
  std::set<std::uint64_t> keys;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z) keys.insert(morton_key(Vec3i(-8 + x, 16 + y, 8 + z)));
  EXPECT_EQ(keys.size(), 512U);
  EXPECT_EQ(*keys.rbegin() - *keys.begin(), 511U);
}

TEST(Morton, NegativeCoordinatesComeFirst) {
  EXPECT_LT(morton_key({-1, 0, 0}), morton_key({0, 0, 0}));
  EXPECT_LT(morton_key({-1, -1, -1}), morton_key({0, 0, -1}));
  EXPECT_LT(morton_key({-5, 3, 2}), morton_key({5, 3, 2}));
}

}  // namespace
}  // namespace lahar::lbm
