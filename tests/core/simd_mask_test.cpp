#include "core/simd_mask.h"

#include <gtest/gtest.h>

#include <array>

namespace lahar {
namespace {

template <class M>
class SimdMask : public testing::Test {};
using Masks =
    testing::Types<Mask<float, 4>, Mask<float, 8>, Mask<float, 16>, Mask<double, 2>, Mask<double, 4>, Mask<double, 8>>;
TYPED_TEST_SUITE(SimdMask, Masks);

TYPED_TEST(SimdMask, holds_bits) {
  using M = TypeParam;
  for (unsigned bits = 0; bits <= M::kAll; bits += M::kAll > 255 ? 251 : 1) {
    const M m = M::from_bits(bits);
    EXPECT_EQ(m.bits(), bits);
    for (std::size_t k = 0; k < M::size(); ++k) EXPECT_EQ(m[k], (bits >> k & 1U) != 0);
    EXPECT_EQ((!m).bits(), ~bits & M::kAll);
    EXPECT_EQ(any(m), bits != 0);
    EXPECT_EQ(none(m), bits == 0);
    EXPECT_EQ(all(m), bits == M::kAll);
    EXPECT_EQ(count(m), std::popcount(bits));
    std::array<bool, 17> bytes{};
    bytes[M::size()] = true;
    store(bytes.data(), m);
    for (std::size_t k = 0; k < M::size(); ++k) EXPECT_EQ(bytes[k], m[k]);
    EXPECT_TRUE(bytes[M::size()]);
  }
}

TYPED_TEST(SimdMask, joins_conditions) {
  using M = TypeParam;
  const unsigned a = 0x9C6DU & M::kAll, b = 0x35A9U & M::kAll;
  EXPECT_EQ((M::from_bits(a) && M::from_bits(b)).bits(), a & b);
  EXPECT_EQ((M::from_bits(a) || M::from_bits(b)).bits(), a | b);
  EXPECT_EQ(M::all(true).bits(), M::kAll);
  EXPECT_EQ(M::all(false).bits(), 0U);
  M m = M::all(false);
  m.set(1, true);
  EXPECT_EQ(m.bits(), 2U);
  m.set(1, false);
  EXPECT_EQ(m.bits(), 0U);
}

TEST(SimdMask, a_condition_of_one_number_is_a_mask) {
  EXPECT_TRUE(any(true) && all(true) && !none(true));
  EXPECT_TRUE(none(false) && !any(false) && !all(false));
  EXPECT_EQ(count(true) + count(false), 1);
}

}  // namespace
}  // namespace lahar
