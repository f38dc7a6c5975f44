#pragma once
// What the machine's memory can deliver to an update in place: every number is read, changed and written back.
#include <cstddef>

namespace lahar::performance {

/// GB/s (1e9 bytes, reads and writes both counted) with as many threads as are in force; the best of `repeats` passes
/// over `bytes` of memory. The update is a[i] = a[i] s + t in float.
double stream_rate(std::size_t bytes, int repeats);

}  // namespace lahar::performance
