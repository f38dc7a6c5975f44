#pragma once
// Constants for code that is written once for numbers and for SIMD vectors of numbers.
#include <type_traits>

namespace lahar::lbm {

/// x as a V: converted to V's number type, then spread over its lanes.
template <class V>
constexpr V number(double x) {
  if constexpr (std::is_arithmetic_v<V>)
    return static_cast<V>(x);
  else
    return V(static_cast<typename V::value_type>(x));
}

}  // namespace lahar::lbm
