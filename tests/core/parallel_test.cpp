#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/vector.h"

namespace lahar {
namespace {

TEST(ParallelFor, VisitsEachIndexOnce) {
  for (const std::size_t n : {0, 1, 7, 1000, 4097}) {
    std::vector<std::atomic<int>> visits(n + 2);
    parallel_for(1, n + 1, 16, [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(visits.front(), 0);
    EXPECT_EQ(visits.back(), 0);
    for (std::size_t i = 1; i <= n; ++i) EXPECT_EQ(visits[i], 1) << i << " of " << n;
  }
}

TEST(ParallelFor, AnEmptyRangeCallsNothing) {
  int calls = 0;
  parallel_for(5, 5, 1, [&](std::size_t) { ++calls; });
  parallel_for(6, 5, 1, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 0);
}

TEST(ParallelForChunks, ChunksTileTheRange) {
  constexpr std::size_t n = 1003, chunk = 64;
  std::vector<std::size_t> length((n + chunk - 1) / chunk);
  parallel_for_chunks(n, chunk, [&](std::size_t first, std::size_t last) {
    ASSERT_EQ(first % chunk, 0u);
    length[first / chunk] = last - first;
  });
  for (std::size_t c = 0; c + 1 < length.size(); ++c) EXPECT_EQ(length[c], chunk);
  EXPECT_EQ(length.back(), n % chunk);
}

// Terms of widely different size: another order of summation gives another sum, so equality to the last bit shows
// that the order is kept.
double rough_term(std::size_t i) { return std::pow(-1.0, i % 3) * std::exp(30.0 * std::sin(static_cast<double>(i))); }

double sum_with_threads(int threads, std::size_t n) {
  const ThreadLimit limit(threads);
  return ordered_sum<double>(n, rough_term);
}

TEST(OrderedSum, DoesNotDependOnTheNumberOfThreads) {
  constexpr std::size_t n = 50'003;
  const double one = sum_with_threads(1, n);
  for (const int threads : {2, 3, 4, 8})
    for (int repeat = 0; repeat < 5; ++repeat) EXPECT_EQ(sum_with_threads(threads, n), one) << threads << " threads";
}

TEST(OrderedSum, TheTermsOfThisTestDoFeelTheirOrder) {
  constexpr std::size_t n = 50'003;
  double backwards = 0;
  for (std::size_t i = n; i-- > 0;) backwards += rough_term(i);
  EXPECT_NE(backwards, sum_with_threads(1, n));
}

TEST(OrderedSum, IsExactForIntegers) {
  for (const std::size_t n : {0, 1, 1023, 1024, 1025, 100'000}) {
    const auto sum = ordered_sum<std::int64_t>(n, [](std::size_t i) { return static_cast<std::int64_t>(i); });
    EXPECT_EQ(sum, static_cast<std::int64_t>(n) * (static_cast<std::int64_t>(n) - 1) / 2);
  }
}

TEST(OrderedSum, SumsVectors) {
  const Vec3 sum = ordered_sum<Vec3>(
      3000, [](std::size_t i) { return Vec3(1, static_cast<double>(i), -1); }, 128, Vec3::Zero());
  EXPECT_EQ(sum, Vec3(3000, 3000.0 * 2999 / 2, -3000));
}

TEST(ThreadLimit, HoldsWhileItLives) {
  const int before = thread_count();
  {
    const ThreadLimit limit(1);
    EXPECT_EQ(thread_count(), 1);
  }
  EXPECT_EQ(thread_count(), before);
}

TEST(ThreadLimit, FewerThanOneMeansOne) {
  const ThreadLimit limit(0);
  EXPECT_EQ(thread_count(), 1);
}

}  // namespace
}  // namespace lahar
