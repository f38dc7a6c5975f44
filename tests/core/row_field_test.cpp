#include "core/row_field.h"

#include <gtest/gtest.h>

namespace lahar {
namespace {

TEST(RowField, rows_lie_one_after_the_other_at_addresses_that_suit_packs) {
  RowField f;
  f.resize(5);
  ASSERT_EQ(f.size(), 5U);
  for (std::size_t k = 0; k < f.size(); ++k) {
    EXPECT_EQ(f[k] - f[0], static_cast<std::ptrdiff_t>(kRow * k));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(f[k]) % sizeof(Row<double>), 0U);
    store_aligned(f[k], Row<double>(static_cast<double>(k)));
  }
  EXPECT_EQ(load_aligned<Row<double>>(f[3])[7], 3);
}

}  // namespace
}  // namespace lahar
