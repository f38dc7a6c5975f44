#pragma once
// a b + c in one rounding where the processor has that, in two where it has not: the same for all callers. What the
// compiler makes of a * b + c differs from place to place.
#include <experimental/simd>
#include <type_traits>

namespace lahar {

/// Of numbers or SIMD vectors of them. The library's own fma of vectors takes one lane at a time in longer functions
/// (GCC 12); the loop over lanes becomes one instruction.
template <class V>
[[gnu::always_inline]] inline V multiply_add(const V& a, const V& b, const V& c) {
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  if constexpr (std::is_same_v<V, float>) {
    return __builtin_fmaf(a, b, c);
  } else if constexpr (std::is_same_v<V, double>) {
    return __builtin_fma(a, b, c);
  } else {
    namespace stdx = std::experimental;
    using Number = typename V::value_type;
    alignas(64) Number factor[V::size()], other[V::size()], sum[V::size()];
    a.copy_to(factor, stdx::vector_aligned), b.copy_to(other, stdx::vector_aligned);
    c.copy_to(sum, stdx::vector_aligned);
    for (std::size_t k = 0; k < V::size(); ++k) sum[k] = multiply_add(factor[k], other[k], sum[k]);
    return V(sum, stdx::vector_aligned);
  }
#else
  return a * b + c;
#endif
}

}  // namespace lahar
