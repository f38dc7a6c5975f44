#pragma once
// Roots for vectorized kernels: the divider of processors handles a vector of doubles in 16 to 24 cycles,
// multiplications take half of one.
#include <bit>
#include <cstdint>

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

}  // namespace lahar::dem
