#pragma once
// Base-2 logarithm and exponential for numbers and packs of them: no branch, no library call per lane. Relative error
// of both below 1e-6 in float and 1e-13 in double (tests/lbm/rheology/rheology_test.cpp), for arguments above the
// smallest normal number and exponents within +-100.
#include <bit>
#include <cstdint>
#include <type_traits>

#include "core/simd_math.h"

namespace lahar::lbm {

/// How V's numbers are laid out, and the vectors of whole numbers of the same size.
template <class V>
struct BitLayout {
  static constexpr bool single = sizeof(NumberOf<V>) == 4;
  using Bits = std::conditional_t<single, std::uint32_t, std::uint64_t>;
  using SignedBits = std::conditional_t<single, std::int32_t, std::int64_t>;
  using Unsigned = typename LanesOf<V>::template With<Bits>;
  using Signed = typename LanesOf<V>::template With<SignedBits>;
  static constexpr int mantissa = single ? 23 : 52;
  static constexpr Bits bias = single ? 127 : 1023;
  /// 1.5 x 2^mantissa: added to a number it rounds it to a whole one, which then stands in the lowest bits.
  static constexpr double rounder = 1.5 * static_cast<double>(std::uint64_t{1} << mantissa);
};

/// log2 x, x > 0: x = 2^e m with m in [sqrt(1/2), sqrt(2)), ln m = 2 artanh((m - 1) / (m + 1)).
template <class V>
[[gnu::always_inline]] inline V log2_of(const V& x) {
  using L = BitLayout<V>;
  using Unsigned = typename L::Unsigned;
  const auto bits = std::bit_cast<Unsigned>(x);
  const auto above =
      std::bit_cast<typename L::Signed>(Unsigned(bits - std::bit_cast<Unsigned>(number<V>(0.70710678118654752440))));
  const auto e = std::bit_cast<Unsigned>(typename L::Signed(above >> L::mantissa));
  const V m = std::bit_cast<V>(Unsigned(bits - (e << L::mantissa)));
  const V s = (m - V(1)) / (m + V(1)), s2 = s * s;
  V sum(0);
  for (int k = L::single ? 9 : 19; k >= 1; k -= 2) sum = sum * s2 + number<V>(1.0 / k);
  const V rounder = number<V>(L::rounder);
  const V whole = std::bit_cast<V>(Unsigned(std::bit_cast<Unsigned>(rounder) + e)) - rounder;
  return whole + number<V>(2 / 0.69314718055994530942) * s * sum;
}

/// (ln 2)^k / k!
constexpr double exp2_coefficient(int k) { return k == 0 ? 1 : exp2_coefficient(k - 1) * 0.69314718055994530942 / k; }

/// 2^x: the whole part goes into the exponent, the rest through the series of the exponential.
template <class V>
[[gnu::always_inline]] inline V exp2_of(const V& x) {
  using L = BitLayout<V>;
  using Unsigned = typename L::Unsigned;
  const V rounder = number<V>(L::rounder), rounded = x + rounder;
  const V t = x - (rounded - rounder);
  constexpr int last = L::single ? 7 : 13;
  V sum = number<V>(exp2_coefficient(last));
  for (int k = last - 1; k >= 0; --k) sum = sum * t + number<V>(exp2_coefficient(k));
  const Unsigned exponent = std::bit_cast<Unsigned>(rounded) + Unsigned(L::bias);
  return sum * std::bit_cast<V>(Unsigned(exponent << L::mantissa));
}

}  // namespace lahar::lbm
