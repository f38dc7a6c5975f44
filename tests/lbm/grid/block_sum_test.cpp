#include "lbm/grid/block_sum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// Terms of many sizes: in another order their sum has other bits.
double term(const Vec3i& block) { return std::exp(2.3 * block.x() - 1.7 * block.y() + 0.9 * block.z()) / 3; }

double sum_of(const FluidGrid<double>& grid) {
  return sum_over_blocks<double>(grid, [&](BlockIndex b) {
    const Vec3i& block = grid.topology().coordinate(b);
    return block.minCoeff() >= 5 ? 0.0 : term(block);
  });
}

TEST(BlockSum, DependsOnNeitherHistoryNorEmptyBlocks) {
  DomainSpec spec;
  spec.cell_size = 1;
  spec.upper = Vec3(60, 60, 60);
  FluidGrid<double> one(spec, 1), other(spec, 1);
  std::vector<Vec3i> blocks;
  for (int k = 0; k < 64; ++k) blocks.emplace_back(k % 4, k / 4 % 4, k / 16);
  one.require_blocks(blocks);
  for (int k = 0; k < 3; ++k) other.require_block({5, 6, 5 + k});
  other.release(other.topology().find({5, 6, 6}));
  for (int k = 0; k < 64; ++k) other.require_block(blocks[static_cast<std::size_t>(k * 37 % 64)]);
  const double sum = sum_of(one);
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(sum_of(one), sum);
    EXPECT_EQ(sum_of(other), sum);
  }
  double backwards = 0;
  for (auto b = blocks.rbegin(); b != blocks.rend(); ++b) backwards += term(*b);
  EXPECT_NE(backwards, sum) << "the order would not be noticed";
  EXPECT_NEAR(backwards / sum, 1, 1e-12);
}

}  // namespace
}  // namespace lahar::lbm
