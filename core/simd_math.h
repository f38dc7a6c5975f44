#pragma once
// Functions of numbers and packs (simd.h): least and greatest, a product and a sum in one, roots.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/simd.h"

namespace lahar {

namespace detail {

// One instruction each. Without noexcept the compiler takes the intrinsics for calls that may throw, and no product is
// contracted with a sum across them. Of vectors of 512 bits by way of a mask of all lanes: without one, GCC 12 warns of
// its own header.
#if defined(__SSE2__)
[[gnu::always_inline]] inline __m128 lesser(__m128 a, __m128 b) noexcept { return _mm_min_ps(a, b); }
[[gnu::always_inline]] inline __m128 greater(__m128 a, __m128 b) noexcept { return _mm_max_ps(a, b); }
[[gnu::always_inline]] inline __m128 square_root(__m128 a) { return _mm_sqrt_ps(a); }
[[gnu::always_inline]] inline __m128d lesser(__m128d a, __m128d b) noexcept { return _mm_min_pd(a, b); }
[[gnu::always_inline]] inline __m128d greater(__m128d a, __m128d b) noexcept { return _mm_max_pd(a, b); }
[[gnu::always_inline]] inline __m128d square_root(__m128d a) { return _mm_sqrt_pd(a); }
#if defined(__AVX__)
[[gnu::always_inline]] inline __m256 lesser(__m256 a, __m256 b) noexcept { return _mm256_min_ps(a, b); }
[[gnu::always_inline]] inline __m256 greater(__m256 a, __m256 b) noexcept { return _mm256_max_ps(a, b); }
[[gnu::always_inline]] inline __m256 square_root(__m256 a) { return _mm256_sqrt_ps(a); }
[[gnu::always_inline]] inline __m256d lesser(__m256d a, __m256d b) noexcept { return _mm256_min_pd(a, b); }
[[gnu::always_inline]] inline __m256d greater(__m256d a, __m256d b) noexcept { return _mm256_max_pd(a, b); }
[[gnu::always_inline]] inline __m256d square_root(__m256d a) { return _mm256_sqrt_pd(a); }
#endif
#if defined(__FMA__)
[[gnu::always_inline]] inline __m128 fused(__m128 a, __m128 b, __m128 c) noexcept { return _mm_fmadd_ps(a, b, c); }
[[gnu::always_inline]] inline __m128d fused(__m128d a, __m128d b, __m128d c) noexcept { return _mm_fmadd_pd(a, b, c); }
[[gnu::always_inline]] inline __m256 fused(__m256 a, __m256 b, __m256 c) noexcept { return _mm256_fmadd_ps(a, b, c); }
[[gnu::always_inline]] inline __m256d fused(__m256d a, __m256d b, __m256d c) noexcept {
  return _mm256_fmadd_pd(a, b, c);
}
#endif
#if defined(__AVX512F__)
[[gnu::always_inline]] inline __m512 lesser(__m512 a, __m512 b) noexcept { return _mm512_maskz_min_ps(0xffff, a, b); }
[[gnu::always_inline]] inline __m512 greater(__m512 a, __m512 b) noexcept { return _mm512_maskz_max_ps(0xffff, a, b); }
[[gnu::always_inline]] inline __m512 square_root(__m512 a) { return _mm512_maskz_sqrt_ps(0xffff, a); }
[[gnu::always_inline]] inline __m512 fused(__m512 a, __m512 b, __m512 c) noexcept { return _mm512_fmadd_ps(a, b, c); }
[[gnu::always_inline]] inline __m512d lesser(__m512d a, __m512d b) noexcept { return _mm512_maskz_min_pd(0xff, a, b); }
[[gnu::always_inline]] inline __m512d greater(__m512d a, __m512d b) noexcept { return _mm512_maskz_max_pd(0xff, a, b); }
[[gnu::always_inline]] inline __m512d square_root(__m512d a) { return _mm512_maskz_sqrt_pd(0xff, a); }
[[gnu::always_inline]] inline __m512d fused(__m512d a, __m512d b, __m512d c) noexcept {
  return _mm512_fmadd_pd(a, b, c);
}
#endif
#endif

/// function(piece of a, piece of b...) on pieces that the processor has vectors for, joined.
template <class Function, class T, int N, class... Others>
[[gnu::always_inline]] inline Pack<T, N> by_pieces(const Function& function, const Pack<T, N>& a, const Others&... b) {
  if constexpr (sizeof a > kVectorBytes)
    return join(by_pieces(function, half_of<0>(a), half_of<0>(b)...),
                by_pieces(function, half_of<1>(a), half_of<1>(b)...));
  else
    return Pack<T, N>(typename Pack<T, N>::Storage(function(a.storage(), b.storage()...)));
}

}  // namespace detail

/// The lesser; the second where one is not a number.
template <class T>
requires std::is_arithmetic_v<T>
[[gnu::always_inline]] inline T min(T a, T b) { return a < b ? a : b; }
template <class T, int N>
[[gnu::always_inline]] inline Pack<T, N> min(const Pack<T, N>& a, const Pack<T, N>& b) {
#if defined(__SSE2__)
  return detail::by_pieces(
      [](auto x, auto y) __attribute__((always_inline)) { return detail::lesser(x, y); }, a, b);
#else
  return select(a < b, a, b);
#endif
}

/// The greater; the second where one is not a number.
template <class T>
requires std::is_arithmetic_v<T>
[[gnu::always_inline]] inline T max(T a, T b) { return a > b ? a : b; }
template <class T, int N>
[[gnu::always_inline]] inline Pack<T, N> max(const Pack<T, N>& a, const Pack<T, N>& b) {
#if defined(__SSE2__)
  return detail::by_pieces(
      [](auto x, auto y) __attribute__((always_inline)) { return detail::greater(x, y); }, a, b);
#else
  return select(a > b, a, b);
#endif
}

/// The greatest of the lanes.
template <class T, int N>
[[gnu::always_inline]] inline T greatest_lane(const Pack<T, N>& a) {
  return detail::fold(
      a, [](const auto& x, const auto& y) __attribute__((always_inline)) { return max(x, y); });
}

template <class T>
requires std::is_arithmetic_v<T>
[[gnu::always_inline]] inline T abs(T x) { return std::abs(x); }
template <class T, int N>
[[gnu::always_inline]] inline Pack<T, N> abs(const Pack<T, N>& a) {
  using Bits = Pack<std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>, N>;
  return std::bit_cast<Pack<T, N>>(std::bit_cast<Bits>(a) &
                                   Bits(std::numeric_limits<typename Bits::value_type>::max()));
}

/// Neither infinite nor not a number.
inline bool is_finite(float x) { return std::isfinite(x); }
inline bool is_finite(double x) { return std::isfinite(x); }
template <class T, int N>
[[gnu::always_inline]] inline Mask<T, N> is_finite(const Pack<T, N>& a) {
  return abs(a) <= Pack<T, N>(std::numeric_limits<T>::max());
}

/// Correctly rounded.
template <class T>
requires std::is_arithmetic_v<T>
[[gnu::always_inline]] inline auto sqrt(T x) { return std::sqrt(x); }
template <class T, int N>
[[gnu::always_inline]] inline Pack<T, N> sqrt(const Pack<T, N>& a) {
#if defined(__SSE2__)
  return detail::by_pieces(
      [](auto x) __attribute__((always_inline)) { return detail::square_root(x); }, a);
#else
  Pack<T, N> answer;
  for (std::size_t k = 0; k < N; ++k) answer.set(k, std::sqrt(a[k]));
  return answer;
#endif
}

/// a b + c in one rounding where the processor has that, in two where it has not: the same for all callers. What the
/// compiler makes of a * b + c differs from place to place.
template <class T>
requires std::is_floating_point_v<T>
[[gnu::always_inline]] inline T multiply_add(T a, T b, T c) {
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  if constexpr (std::is_same_v<T, float>)
    return __builtin_fmaf(a, b, c);
  else
    return __builtin_fma(a, b, c);
#else
  return a * b + c;
#endif
}
template <class T, int N>
[[gnu::always_inline]] inline Pack<T, N> multiply_add(const Pack<T, N>& a, const Pack<T, N>& b, const Pack<T, N>& c) {
#if defined(__FMA__)
  return detail::by_pieces(
      [](auto x, auto y, auto z) __attribute__((always_inline)) { return detail::fused(x, y, z); }, a, b, c);
#elif defined(__ARM_FEATURE_FMA)
  Pack<T, N> answer;
  for (std::size_t k = 0; k < N; ++k) answer.set(k, multiply_add(a[k], b[k], c[k]));
  return answer;
#else
  return a * b + c;
#endif
}

namespace detail {

/// One step of third order towards 1 / sqrt(x).
template <class V>
[[gnu::always_inline]] inline V closer_inverse_root(const V& x, const V& y) {
  const V error = V(1) - (x * y) * y;
  return y + (y * error) * (V(0.5) + V(0.375) * error);
}

}  // namespace detail

/// 1 / sqrt(x) to two units in the last place, for x from 1e-300 to 1e300. Finite for x = 0, so that
/// x * inverse_root(x) is sqrt(x) there too. The divider of processors handles a vector of doubles in 16 to 24 cycles,
/// multiplications take half of one. Starts from half the exponent (Lomont 2003, "Fast inverse square root") with an
/// error of 3.5 %, then two steps of third order and one of second.
[[gnu::always_inline]] inline double inverse_root(double x) {
  double y = std::bit_cast<double>(0x5fe6eb50c7b537a9 - (std::bit_cast<std::int64_t>(x) >> 1));
  y = detail::closer_inverse_root(x, detail::closer_inverse_root(x, y));
  return y + (0.5 * y) * (1 - (x * y) * y);
}
template <int N>
[[gnu::always_inline]] inline Pack<double, N> inverse_root(const Pack<double, N>& x) {
  using P = Pack<double, N>;
#ifdef __AVX512F__
  // From the processor's estimate, wrong by at most 2^-14, and one step of fourth order: what is left out is
  // 35/128 (2^-13)^4 < 2^-53.
  if constexpr (N >= 8) {
    const P bounded = max(x, P(1e-300));  // the estimate for 0 is not finite
    const P y = detail::by_pieces(
        [](auto piece) __attribute__((always_inline)) { return _mm512_maskz_rsqrt14_pd(0xff, piece); }, bounded);
    const P error = 1 - (bounded * y) * y;
    return y + (y * error) * (P(0.5) + error * (P(0.375) + P(0.3125) * error));
  }
#endif
  using Bits = Pack<std::int64_t, N>;
  P y = std::bit_cast<P>(Bits(std::int64_t{0x5fe6eb50c7b537a9}) - (std::bit_cast<Bits>(x) >> 1));
  y = detail::closer_inverse_root(x, detail::closer_inverse_root(x, y));
  return y + (P(0.5) * y) * (1 - (x * y) * y);
}
/// The same in float by division and root, which there cost no more. Finite for x = 0.
inline float inverse_root(float x) { return 1 / std::sqrt(max(x, 1e-37F)); }
template <int N>
[[gnu::always_inline]] inline Pack<float, N> inverse_root(const Pack<float, N>& x) {
  return 1 / sqrt(max(x, Pack<float, N>(1e-37F)));
}

/// sqrt(x) by multiplications where that is cheaper: of packs of doubles to two units in the last place.
inline float root(float x) { return std::sqrt(x); }
inline double root(double x) { return std::sqrt(x); }
template <int N>
[[gnu::always_inline]] inline Pack<float, N> root(const Pack<float, N>& x) {
  return sqrt(x);
}
template <int N>
[[gnu::always_inline]] inline Pack<double, N> root(const Pack<double, N>& x) {
  return x * inverse_root(x);
}

}  // namespace lahar
