#pragma once
// Roots, least, greatest and choice for kernels that are written once for numbers and for lines of eight. The divider
// of processors handles a vector of doubles in 16 to 24 cycles, multiplications take half of one.
#include <bit>
#include <cmath>
#include <cstdint>

#include "dem/lanes.h"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace lahar::dem {

/// 1 / sqrt(x) to two units in the last place, for x from 1e-300 to 1e300. Finite for x = 0, so that
/// x * inverse_root(x) is sqrt(x) there too. Starts from half the exponent (Lomont 2003, "Fast inverse square root")
/// with an error of 3.5 %, then two steps of third order and one of second.
inline double inverse_root(double x) {
  double y = std::bit_cast<double>(0x5fe6eb50c7b537a9 - (std::bit_cast<std::int64_t>(x) >> 1));
  double error = 1 - (x * y) * y;
  y += (y * error) * (0.5 + 0.375 * error);
  error = 1 - (x * y) * y;
  y += (y * error) * (0.5 + 0.375 * error);
  return y + (0.5 * y) * (1 - (x * y) * y);
}

/// The second where the first is not a number.
inline double smaller(double a, double b) { return a < b ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }
inline double choose(bool condition, double a, double b) { return condition ? a : b; }
inline double root(double x) { return std::sqrt(x); }

#ifdef __AVX512F__
[[gnu::always_inline]] inline Line smaller(const Line& a, const Line& b) {
  return Line(_mm512_maskz_min_pd(0xff, a, b));
}
[[gnu::always_inline]] inline Line larger(const Line& a, const Line& b) {
  return Line(_mm512_maskz_max_pd(0xff, a, b));
}

/// The same from the processor's estimate, wrong by at most 2^-14, and one step of fourth order: what is left out is
/// 35/128 (2^-13)^4 < 2^-53.
[[gnu::always_inline]] inline Line inverse_root(const Line& any) {
  const Line x = larger(any, Line{} + 1e-300);  // the estimate for 0 is not finite
  const Line y = Line(_mm512_maskz_rsqrt14_pd(0xff, x));
  const Line error = 1 - (x * y) * y;
  return y + (y * error) * (0.5 + error * (0.375 + 0.3125 * error));
}
#else
[[gnu::always_inline]] inline Line smaller(const Line& a, const Line& b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Line larger(const Line& a, const Line& b) { return a > b ? a : b; }

[[gnu::always_inline]] inline Line inverse_root(const Line& x) {
  LineMask half;
  __builtin_memcpy(&half, &x, sizeof half);
  const LineMask start = 0x5fe6eb50c7b537a9 - (half >> 1);
  Line y;
  __builtin_memcpy(&y, &start, sizeof y);
  Line error = 1 - (x * y) * y;
  y += (y * error) * (0.5 + 0.375 * error);
  error = 1 - (x * y) * y;
  y += (y * error) * (0.5 + 0.375 * error);
  return y + (0.5 * y) * (1 - (x * y) * y);
}
#endif

[[gnu::always_inline]] inline Line choose(const LineMask& condition, const Line& a, const Line& b) {
  return condition ? a : b;
}
/// To two units in the last place.
[[gnu::always_inline]] inline Line root(const Line& x) { return x * inverse_root(x); }

}  // namespace lahar::dem
