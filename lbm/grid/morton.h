#pragma once
// Morton order of blocks (Morton 1966): the bits of the three coordinates interleaved, x lowest. Blocks that are near
// in this order are near in space, so that a run of it is a compact part of the domain.
#include <cstdint>

#include "core/vector.h"

namespace lahar::lbm {

/// Every third bit of the result is one of the lowest 21 bits of `v`.
constexpr std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1FFFFFU;
  v = (v | v << 32) & 0x001F00000000FFFFU;
  v = (v | v << 16) & 0x001F0000FF0000FFU;
  v = (v | v << 8) & 0x100F00F00F00F00FU;
  v = (v | v << 4) & 0x10C30C30C30C30C3U;
  return (v | v << 2) & 0x1249249249249249U;
}

/// Place of a block coordinate in the order; each coordinate in [-2^20, 2^20).
inline std::uint64_t morton_key(const Vec3i& block) {
  constexpr int offset = 1 << 20;
  const auto bits = [](int v) { return spread_bits(static_cast<std::uint64_t>(v + offset)); };
  return bits(block.x()) | bits(block.y()) << 1 | bits(block.z()) << 2;
}

}  // namespace lahar::lbm
