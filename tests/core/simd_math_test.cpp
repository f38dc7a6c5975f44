#include "core/simd_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lahar {
namespace {

template <class P>
class SimdMath : public testing::Test {
 protected:
  using Number = typename P::value_type;
  static P pack(double first, double ratio) {
    P p;
    for (std::size_t k = 0; k < P::size(); ++k)
      p.set(k, static_cast<Number>((k % 2 == 0 ? 1 : -1) * first * std::pow(ratio, static_cast<double>(k))));
    return p;
  }
};
using Packs =
    testing::Types<Pack<float, 4>, Pack<float, 8>, Pack<float, 16>, Pack<double, 4>, Pack<double, 8>, Pack<double, 16>>;
TYPED_TEST_SUITE(SimdMath, Packs);

TYPED_TEST(SimdMath, agrees_with_numbers) {
  using T = typename TypeParam::value_type;
  const auto a = this->pack(1.37, 1.61), b = this->pack(-2.21, 1.43), c = this->pack(0.3, 1.9);
  for (std::size_t k = 0; k < TypeParam::size(); ++k) {
    EXPECT_EQ(min(a, b)[k], std::min(a[k], b[k]));
    EXPECT_EQ(max(a, b)[k], std::max(a[k], b[k]));
    EXPECT_EQ(min(a, b)[k], min(a[k], b[k]));
    EXPECT_EQ(max(a, b)[k], max(a[k], b[k]));
    EXPECT_EQ(abs(a)[k], std::abs(a[k]));
    EXPECT_EQ(sqrt(abs(a))[k], std::sqrt(std::abs(a[k])));
    EXPECT_EQ(multiply_add(a, b, c)[k], multiply_add(a[k], b[k], c[k]));
    EXPECT_NEAR(root(abs(a))[k] / std::sqrt(std::abs(a[k])), 1, 3 * std::numeric_limits<T>::epsilon());
    EXPECT_NEAR(inverse_root(abs(a))[k] * std::sqrt(std::abs(a[k])), 1, 3 * std::numeric_limits<T>::epsilon());
  }
}

TYPED_TEST(SimdMath, finds_the_greatest_lane) {
  for (std::size_t k = 0; k < TypeParam::size(); ++k) {
    TypeParam p(-3);
    p.set(k, -2);
    EXPECT_EQ(greatest_lane(p), -2);
    p.set(k, 7);
    EXPECT_EQ(greatest_lane(p), 7);
  }
}

TYPED_TEST(SimdMath, what_is_not_a_number_gives_way_to_the_second) {
  using T = typename TypeParam::value_type;
  const T none = std::numeric_limits<T>::quiet_NaN(), infinite = std::numeric_limits<T>::infinity();
  TypeParam p(2);
  p.set(1, none);
  EXPECT_EQ(min(none, T(1)), 1);
  EXPECT_EQ(max(none, T(1)), 1);
  EXPECT_EQ(min(p, TypeParam(1))[1], 1);
  EXPECT_EQ(max(p, TypeParam(1))[1], 1);
  EXPECT_EQ(max(p, TypeParam(1))[2], 2);
  EXPECT_TRUE(std::isnan(max(TypeParam(1), p)[1]));
  p.set(2, infinite), p.set(3, -infinite);
  EXPECT_EQ(is_finite(p).bits(), (1U << p.size()) - 1 - 0xEU);
  EXPECT_FALSE(is_finite(none));
}

TYPED_TEST(SimdMath, root_of_zero_is_zero) {
  EXPECT_TRUE(all(is_finite(inverse_root(TypeParam(0)))));
  EXPECT_EQ(root(TypeParam(0))[3], 0);
  EXPECT_EQ(sqrt(TypeParam(0))[3], 0);
}

#if defined(__FMA__)
TYPED_TEST(SimdMath, multiply_add_rounds_once) {
  using T = typename TypeParam::value_type;
  const T one_up = 1 + std::numeric_limits<T>::epsilon();
  EXPECT_GT(multiply_add(TypeParam(one_up), TypeParam(one_up), TypeParam(-one_up * one_up))[0], 0);
  EXPECT_GT(multiply_add(one_up, one_up, T(-one_up * one_up)), 0);
}
#endif

TEST(SimdRoots, inverse_root_is_right_to_two_units_in_the_last_place) {
  double worst = 0;
  const auto look = [&](double x) {
    worst = std::max(worst, std::abs(inverse_root(x) * std::sqrt(x) - 1));
    const double factor[] = {1, 1.1, 1.3, 1.7, 2.1, 2.9, 3.3, 3.9};
    const Row<double> factors = load<Row<double>>(factor), l = inverse_root(x * factors);
    for (std::size_t k = 0; k < kRow; ++k) worst = std::max(worst, std::abs(l[k] * std::sqrt(factor[k] * x) - 1));
  };
  for (double x = 1e-300; x < 1e299; x *= 1.37) look(x);
  for (double x = 0.5; x < 4; x += 1e-4) look(x);
  EXPECT_LT(worst, 3 * std::numeric_limits<double>::epsilon());  // two, and one for the check's own roundings
}

TEST(SimdRoots, root_of_zero_is_zero) {
  EXPECT_TRUE(std::isfinite(inverse_root(0.0)));
  EXPECT_EQ(0.0 * inverse_root(0.0), 0);
}

}  // namespace
}  // namespace lahar
