#pragma once
// Morton codes (Morton 1966): the bits of three coordinates interleaved, x lowest. What is near in their order is near
// in space.
#include <cstdint>

namespace lahar {

/// Every third bit of the result is one of the lowest 21 bits of `v`.
constexpr std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1FFFFFU;
  v = (v | v << 32) & 0x001F00000000FFFFU;
  v = (v | v << 16) & 0x001F0000FF0000FFU;
  v = (v | v << 8) & 0x100F00F00F00F00FU;
  v = (v | v << 4) & 0x10C30C30C30C30C3U;
  return (v | v << 2) & 0x1249249249249249U;
}

/// Of three numbers of 21 bits.
constexpr std::uint64_t morton_code(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return spread_bits(x) | spread_bits(y) << 1 | spread_bits(z) << 2;
}

}  // namespace lahar
