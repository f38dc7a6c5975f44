#pragma once
// a b + c in one rounding where the processor has that, in two where it has not: the same for all callers. What the
// compiler makes of a * b + c differs from place to place.
#include <type_traits>

namespace lahar {

/// Of numbers or SIMD vectors of them.
template <class V>
[[gnu::always_inline]] inline V multiply_add(const V& a, const V& b, const V& c) {
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  if constexpr (std::is_same_v<V, float>)
    return __builtin_fmaf(a, b, c);
  else if constexpr (std::is_same_v<V, double>)
    return __builtin_fma(a, b, c);
  else
    return fma(a, b, c);
#else
  return a * b + c;
#endif
}

}  // namespace lahar
