#include "core/simd.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace lahar {
namespace {

/// Every operation against a loop over the lanes.
template <class P>
class Simd : public testing::Test {
 protected:
  using Number = typename P::value_type;

  static Number number_at(std::size_t k, int seed) {
    return static_cast<Number>((k * 7 + 3U * static_cast<unsigned>(seed)) % 11) - Number(4.25);
  }
  static P pack(int seed) {
    P p;
    for (std::size_t k = 0; k < P::size(); ++k) p.set(k, number_at(k, seed));
    return p;
  }
  template <class Expected>
  static void expect_lanes(const P& p, const Expected& expected) {
    for (std::size_t k = 0; k < P::size(); ++k) EXPECT_EQ(p[k], expected(k)) << "lane " << k;
  }

  const P one = pack(0), other = pack(1);
};
using Packs =
    testing::Types<Pack<float, 4>, Pack<float, 8>, Pack<float, 16>, Pack<double, 4>, Pack<double, 8>, Pack<double, 16>>;
TYPED_TEST_SUITE(Simd, Packs);

TYPED_TEST(Simd, spreads_numbers) {
  using T = typename TypeParam::value_type;
  this->expect_lanes(TypeParam(3), [](std::size_t) { return T(3); });
  this->expect_lanes(TypeParam(T(0.1)), [](std::size_t) { return T(0.1); });
  this->expect_lanes(number<TypeParam>(0.1), [](std::size_t) { return T(0.1); });
  this->expect_lanes(TypeParam{}, [](std::size_t) { return T(0); });
  EXPECT_TRUE(std::signbit(TypeParam(T(-0.0))[1]));
  EXPECT_EQ(number<T>(0.1), T(0.1));
  this->expect_lanes(lane_index<TypeParam>(), [](std::size_t k) { return static_cast<T>(k); });
  EXPECT_EQ(lane_index<T>(), 0);
}

TYPED_TEST(Simd, computes_lane_by_lane) {
  const auto& a = this->one;
  const auto& b = this->other;
  this->expect_lanes(a + b, [&](std::size_t k) { return a[k] + b[k]; });
  this->expect_lanes(a - b, [&](std::size_t k) { return a[k] - b[k]; });
  this->expect_lanes(a * b, [&](std::size_t k) { return a[k] * b[k]; });
  this->expect_lanes(a / b, [&](std::size_t k) { return a[k] / b[k]; });
  this->expect_lanes(-a, [&](std::size_t k) { return -a[k]; });
  this->expect_lanes(2 * a, [&](std::size_t k) { return 2 * a[k]; });
  TypeParam sum = a;
  sum += b, sum *= b, sum -= a, sum /= b;
  using T = typename TypeParam::value_type;
  this->expect_lanes(sum, [&](std::size_t k) {
    volatile T product = (a[k] + b[k]) * b[k], difference = product - a[k];  // no contraction
    return difference / b[k];
  });
}

TYPED_TEST(Simd, loads_and_stores_at_any_address) {
  using T = typename TypeParam::value_type;
  constexpr std::size_t n = TypeParam::size();
  std::vector<T> memory(3 * n, T(-1));
  store(memory.data() + 1, this->one);
  this->expect_lanes(load<TypeParam>(memory.data() + 1), [&](std::size_t k) { return this->one[k]; });
  EXPECT_EQ(memory[0], -1);
  EXPECT_EQ(memory[n + 1], -1);
  alignas(sizeof(TypeParam)) std::array<T, n> row;
  store_aligned(row.data(), this->other);
  this->expect_lanes(load_aligned<TypeParam>(row.data()), [&](std::size_t k) { return this->other[k]; });
  store(memory.data(), T(5));
  EXPECT_EQ(load<T>(memory.data()), 5);
}

TYPED_TEST(Simd, stores_chosen_lanes_only) {
  using T = typename TypeParam::value_type;
  using M = typename TypeParam::mask_type;
  constexpr std::size_t n = TypeParam::size();
  for (const unsigned bits : {0U, 1U, 0xA5A5U & M::kAll, M::kAll}) {
    std::vector<T> memory(n + 2, T(-9));
    store_if(M::from_bits(bits), memory.data() + 1, this->one);
    EXPECT_EQ(memory[0], -9);
    EXPECT_EQ(memory[n + 1], -9);
    for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(memory[k + 1], (bits >> k & 1U) != 0 ? this->one[k] : T(-9));
  }
}

TYPED_TEST(Simd, gathers) {
  using T = typename TypeParam::value_type;
  std::vector<T> from(100);
  for (std::size_t k = 0; k < from.size(); ++k) from[k] = static_cast<T>(k);
  std::array<std::uint32_t, TypeParam::size()> index;
  for (std::size_t k = 0; k < index.size(); ++k) index[k] = static_cast<std::uint32_t>((37 * k + 5) % 100);
  this->expect_lanes(gather<TypeParam>(from.data(), index.data()), [&](std::size_t k) { return from[index[k]]; });
}

TYPED_TEST(Simd, compares_and_selects) {
  const auto& a = this->one;
  const auto& b = this->other;
  const auto check = [&](const auto& mask, const auto& expected) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < TypeParam::size(); ++k) {
      EXPECT_EQ(mask[k], expected(a[k], b[k]));
      bits |= (expected(a[k], b[k]) ? 1U : 0U) << k;
    }
    EXPECT_EQ(mask.bits(), bits);
    this->expect_lanes(select(mask, a, b), [&](std::size_t k) { return expected(a[k], b[k]) ? a[k] : b[k]; });
  };
  using T = typename TypeParam::value_type;
  check(a < b, [](T x, T y) { return x < y; });
  check(a <= b, [](T x, T y) { return x <= y; });
  check(a > b, [](T x, T y) { return x > y; });
  check(a >= b, [](T x, T y) { return x >= y; });
  check(a == b, [](T x, T y) { return x == y; });
  check(a != b, [](T x, T y) { return x != y; });
  EXPECT_EQ(select(true, T(1), T(2)), 1);
  EXPECT_EQ(select(false, T(1), T(2)), 2);
}

TYPED_TEST(Simd, nothing_compares_with_what_is_not_a_number) {
  using T = typename TypeParam::value_type;
  const TypeParam none(std::numeric_limits<T>::quiet_NaN());
  EXPECT_TRUE(lahar::none(none < this->one));
  EXPECT_TRUE(lahar::none(none >= this->one));
  EXPECT_TRUE(lahar::none(none == none));
  EXPECT_TRUE(all(none != none));
}

TYPED_TEST(Simd, sums_lanes_in_a_fixed_order) {
  using T = typename TypeParam::value_type;
  constexpr std::size_t n = TypeParam::size();
  TypeParam p;
  for (std::size_t k = 0; k < n; ++k) p.set(k, 1 / static_cast<T>(k + 3));
  std::vector<T> left(n);
  store(left.data(), p);
  for (; left.size() * sizeof(T) > 16; left.resize(left.size() / 2))
    for (std::size_t k = 0; k < left.size() / 2; ++k) left[k] += left[k + left.size() / 2];
  const T expected = left.size() == 4 ? (left[0] + left[3]) + (left[1] + left[2]) : left[0] + left[1];
  EXPECT_EQ(sum_of_lanes(p), expected);
}

TYPED_TEST(Simd, shuffles_halves_and_joins) {
  constexpr int n = TypeParam::size();
  const auto& a = this->one;
  const auto& b = this->other;
  const auto both = join(a, b);
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_EQ(both[k], a[k]);
    EXPECT_EQ(both[n + k], b[k]);
  }
  this->expect_lanes(half_of<0>(both), [&](std::size_t k) { return a[k]; });
  this->expect_lanes(half_of<1>(both), [&](std::size_t k) { return b[k]; });
  const auto four = shuffle<1, n, 0, n + 2>(a, b);
  EXPECT_EQ(four[0], a[1]);
  EXPECT_EQ(four[1], b[0]);
  EXPECT_EQ(four[2], a[0]);
  EXPECT_EQ(four[3], b[2]);
}

TYPED_TEST(Simd, transpose_swaps_rows_and_columns) {
  using T = typename TypeParam::value_type;
  constexpr std::size_t n = TypeParam::size();
  std::array<TypeParam, n> m;
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column < n; ++column) m[row].set(column, static_cast<T>(100 * row + column));
  transpose(m);
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column < n; ++column) EXPECT_EQ(m[row][column], static_cast<T>(100 * column + row));
}

TYPED_TEST(Simd, converts) {
  constexpr int n = TypeParam::size();
  const auto as_float = convert<float>(this->one);
  const auto as_double = convert<double>(as_float);
  for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(as_double[k], this->one[k]);  // all are whole quarters
  const auto whole = convert<std::int32_t>(this->one);
  for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(whole[k], static_cast<std::int32_t>(this->one[k]));
}

TEST(SimdWhole, adds_and_shifts) {
  Pack<std::uint32_t, 8> p;
  for (std::size_t k = 0; k < 8; ++k) p.set(k, static_cast<std::uint32_t>(0x80000000U + k));
  const auto q = ((p << 3) >> 1) + Pack<std::uint32_t, 8>(std::uint32_t{5});
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(q[k], ((p[k] << 3) >> 1) + 5);
}

}  // namespace
}  // namespace lahar
