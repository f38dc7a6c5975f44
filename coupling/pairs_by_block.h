#pragma once
// Pairs of a body and a block that it reaches, listed by block. Grains and mapped wires keep their pairs by body;
// fields are written and loads gathered block by block.
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"

namespace lahar::coupling {

class PairsByBlock {
 public:
  /// Counting sort by Pair::block; within a block the pairs stay in the order of the bodies. `blocks`: indices in use.
  template <class Pair>
  void sort(const std::vector<Pair>& pairs, std::size_t blocks) {
    former_start_.swap(start_);
    start_.assign(blocks + 1, 0);
    for (const Pair& p : pairs) ++start_[static_cast<std::size_t>(p.block) + 1];
    for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
    pairs_.resize(pairs.size());
    next_.assign(start_.begin(), start_.end() - 1);
    for (std::uint32_t k = 0; k < pairs.size(); ++k) pairs_[next_[static_cast<std::size_t>(pairs[k].block)]++] = k;
  }

  /// Indices of the pairs of a block.
  [[nodiscard]] std::span<const std::uint32_t> in(std::size_t block) const {
    return std::span(pairs_).subspan(start_[block], count(start_, block));
  }
  [[nodiscard]] bool any_in(std::size_t block) const { return count(start_, block) > 0; }
  /// Whether a block had as many pairs at the sort before the last.
  [[nodiscard]] bool as_many_as_before(std::size_t block) const {
    return count(start_, block) == count(former_start_, block);
  }
  /// Block indices that were sorted by.
  [[nodiscard]] std::size_t blocks() const { return start_.empty() ? 0 : start_.size() - 1; }

  /// Calls visit(block index) in parallel for the blocks with pairs.
  template <class Visit>
  void for_each_block(const Visit& visit) const {
    parallel_for(0, blocks(), 8, [&](std::size_t b) {
      if (start_[b] < start_[b + 1]) visit(b);
    });
  }

 private:
  static std::size_t count(const std::vector<std::uint32_t>& start, std::size_t block) {
    return block + 1 < start.size() ? start[block + 1] - start[block] : 0;
  }

  std::vector<std::uint32_t> pairs_;                 // sorted by block
  std::vector<std::uint32_t> start_, former_start_;  // per block index, into pairs_
  std::vector<std::uint32_t> next_;                  // scratch of the sort
};

}  // namespace lahar::coupling
