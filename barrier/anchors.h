#pragma once
// Places on a cable, given as fractions of its length, as numbers of beads and bonds.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"

namespace lahar::barrier {

/// The nearest of `count` evenly spaced items to each fraction in [0, 1] (0 the first, 1 the last), each once,
/// ascending. Throws InputError for a fraction outside.
[[nodiscard]] inline std::vector<std::size_t> items_at(const std::vector<double>& fractions, std::size_t count) {
  std::vector<std::size_t> items;
  for (const double f : fractions) {
    if (!(f >= 0 && f <= 1)) throw InputError("a place on a cable is a fraction of its length between 0 and 1");
    items.push_back(static_cast<std::size_t>(std::lround(f * static_cast<double>(count - 1))));
  }
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
  return items;
}

/// Numbers 0 .. count - 1.
[[nodiscard]] inline std::vector<std::size_t> all_items(std::size_t count) {
  std::vector<std::size_t> items(count);
  for (std::size_t k = 0; k < count; ++k) items[k] = k;
  return items;
}

}  // namespace lahar::barrier
