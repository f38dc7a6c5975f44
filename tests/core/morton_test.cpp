#include "core/morton.h"

#include <gtest/gtest.h>

namespace lahar {
namespace {

TEST(MortonCode, TakesBitsInTurnWithXLowest) {
  EXPECT_EQ(morton_code(1, 0, 0), 1U);
  EXPECT_EQ(morton_code(0, 1, 0), 2U);
  EXPECT_EQ(morton_code(0, 0, 1), 4U);
  EXPECT_EQ(morton_code(3, 5, 6), 0b110'101'011U);
  // Each of the 63 bits comes from one bit of one coordinate.
  std::uint64_t all = 0;
  for (int bit = 0; bit < 21; ++bit)
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint64_t v = std::uint64_t{1} << bit;
      const std::uint64_t code = morton_code(axis == 0 ? v : 0, axis == 1 ? v : 0, axis == 2 ? v : 0);
      EXPECT_EQ(code, std::uint64_t{1} << (3 * bit + axis));
      all |= code;
    }
  EXPECT_EQ(all, ~std::uint64_t{0} >> 1);
}

}  // namespace
}  // namespace lahar
