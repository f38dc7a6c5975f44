#include "lbm/free_surface/covered_cells.h"

#include <gtest/gtest.h>

#include <memory>

namespace lahar::lbm {
namespace {

TEST(CoveredCells, AreBitsOfTheirRows) {
  Block<float> block;
  EXPECT_FALSE(is_covered(block, 0));
  const auto body = std::make_unique<BodyFields<float>>();
  block.body = body.get();
  body->covered[static_cast<std::size_t>(3 + 8 * 6)] = 1 << 5;  // (5, 3, 6)
  for (int n = 0; n < kBlockCells; ++n) EXPECT_EQ(is_covered(block, n), n == cell_index(5, 3, 6)) << n;
}

}  // namespace
}  // namespace lahar::lbm
