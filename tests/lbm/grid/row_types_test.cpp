#include "lbm/grid/row_types.h"

#include <gtest/gtest.h>

#include <random>

namespace lahar::lbm {
namespace {

TEST(RowTypes, AreThoseOfTheCells) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> any(0, static_cast<int>(CellType::sink));
  Block<float> block;
  for (CellType& type : block.type) type = static_cast<CellType>(any(random));
  for (int row = 0; row < 64; ++row) {
    unsigned wet = 0, interface = 0, empty = 0;
    for (int x = 0; x < kBlockWidth; ++x) {
      const CellType type = block.type[static_cast<std::size_t>(kBlockWidth * row + x)];
      wet |= static_cast<unsigned>(is_wet(type)) << x;
      interface |= static_cast<unsigned>(type == CellType::interface) << x;
      empty |= static_cast<unsigned>(type == CellType::gas || type == CellType::sink) << x;
    }
    EXPECT_EQ(wet_cells(block, row), wet) << row;
    EXPECT_EQ(interface_cells(block, row), interface) << row;
    EXPECT_EQ(empty_cells(types_of_row(block, row)), empty) << row;
  }
}

}  // namespace
}  // namespace lahar::lbm
