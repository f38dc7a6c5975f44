#include "dem/lanes.h"

#include <gtest/gtest.h>

namespace lahar::dem {
namespace {

TEST(Lanes, transpose_swaps_rows_and_columns) {
  std::array<Line, kLine> m;
  for (std::size_t row = 0; row < kLine; ++row)
    for (std::size_t column = 0; column < kLine; ++column) m[row][column] = static_cast<double>(10 * row + column);
  transpose(m);
  for (std::size_t row = 0; row < kLine; ++row)
    for (std::size_t column = 0; column < kLine; ++column)
      EXPECT_EQ(m[row][column], static_cast<double>(10 * column + row));
}

}  // namespace
}  // namespace lahar::dem
