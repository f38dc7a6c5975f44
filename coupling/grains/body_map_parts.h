#pragma once
// What the files of BodyMap share.
#include "core/parallel.h"
#include "coupling/grains/body_map.h"

namespace lahar::coupling {

/// Dry blocks may have been released since the pair was made, and their index used again.
template <class Real>
inline bool BodyMap<Real>::is_alive(const lbm::Fluid<Real>& fluid, const Pair& p) const {
  return fluid.grid().exists(p.block) && fluid.grid().block(p.block).birth == p.birth;
}

template <class Real>
inline std::span<const std::uint32_t> BodyMap<Real>::pairs_of(const std::vector<std::uint32_t>& start,
                                                              std::size_t block) const {
  return std::span(by_block_).subspan(start[block], start[block + 1] - start[block]);
}

/// Prefetches the pairs of a block, which lie by body and thus apart, before they are looked at one by one.
template <class Real>
inline void BodyMap<Real>::prefetch(std::span<const std::uint32_t> pairs) const {
  constexpr std::size_t line = 64;
  for (const std::uint32_t k : pairs) {
    const auto* const first = reinterpret_cast<const char*>(&pairs_[k]);
    __builtin_prefetch(first);
    if constexpr (sizeof(Pair) > line) __builtin_prefetch(first + sizeof(Pair) - 1);
  }
}

/// Calls visit(block index) for the blocks that bodies reach.
template <class Real>
template <class Visit>
void BodyMap<Real>::for_each_block(const Visit& visit) const {
  const std::size_t blocks = block_start_.empty() ? 0 : block_start_.size() - 1;
  parallel_for(0, blocks, 8, [&](std::size_t b) {
    if (block_start_[b] < block_start_[b + 1]) visit(b);
  });
}

}  // namespace lahar::coupling
