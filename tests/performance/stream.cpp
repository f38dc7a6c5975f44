#include "tests/performance/stream.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "core/parallel.h"

namespace lahar::performance {

namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kPiece = std::size_t{1} << 16;  // floats per task

struct Free {
  void operator()(float* p) const { std::free(p); }
};

}  // namespace

double stream_rate(std::size_t bytes, int repeats) {
  using Clock = std::chrono::steady_clock;
  const std::size_t pieces = std::max<std::size_t>(1, bytes / (kPiece * sizeof(float)));
  const std::size_t size = (pieces * kPiece * sizeof(float) + kHugePage - 1) / kHugePage * kHugePage;
  const std::unique_ptr<float, Free> memory(static_cast<float*>(std::aligned_alloc(kHugePage, size)));
  if (!memory) throw std::bad_alloc();
#ifdef __linux__
  madvise(memory.get(), size, MADV_HUGEPAGE);
#endif
  std::fill_n(memory.get(), pieces * kPiece, 1.0F);
  double best = 0;
  for (int r = 0; r < repeats; ++r) {
    const auto start = Clock::now();
    parallel_for(0, pieces, 1, [&](std::size_t p) {
      float* const a = memory.get() + p * kPiece;
      for (std::size_t i = 0; i < kPiece; ++i) a[i] = a[i] * 0.999F + 0.001F;
    });
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    best = std::max(best, 2.0 * static_cast<double>(pieces * kPiece * sizeof(float)) / seconds / 1e9);
  }
  return best;
}

}  // namespace lahar::performance
