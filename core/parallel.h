#pragma once
// The one place where threads are started (TBB). Reductions are ordered: fixed chunks, summed in index order, so that
// a result does not depend on the number of threads.
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

// A function that the compiler neither puts into its callers nor copies for some of them.
#if defined(__GNUC__) && !defined(__clang__)
#define LAHAR_ONE_COPY [[gnu::noinline, gnu::noclone]]
#else
#define LAHAR_ONE_COPY [[gnu::noinline]]
#endif

namespace lahar {

/// Limits the number of threads while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : control_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(std::max(1, threads))) {}

 private:
  tbb::global_control control_;
};

/// Number of threads in force.
inline int thread_count() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

/// The one loop that both the calling thread alone and threads of TBB run: two copies might be compiled to other
/// roundings, and results would depend on the number of threads.
template <class Body>
LAHAR_ONE_COPY void run_range(const Body& body, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) body(i);
}

/// Calls body(i) for i in [begin, end); body may write only to what belongs to i.
template <class Body>
void parallel_for(std::size_t begin, std::size_t end, std::size_t grain, const Body& body) {
  if (end <= begin) return;
  if (end - begin <= grain || thread_count() == 1) return run_range(body, begin, end);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                    [&](const auto& range) { run_range(body, range.begin(), range.end()); });
}

/// Calls body(first, last) on fixed chunks of [0, n): for loops that vectorize inside a chunk.
template <class Body>
void parallel_for_chunks(std::size_t n, std::size_t chunk, const Body& body) {
  const std::size_t chunks = (n + chunk - 1) / chunk;
  parallel_for(0, chunks, 1, [&](std::size_t c) { body(c * chunk, std::min(n, (c + 1) * chunk)); });
}

/// The same for loops whose chunks all take the same time: each thread gets one run of chunks, the same in every call,
/// so that it finds in its cache what it left there, and nothing is spent on balance.
template <class Body>
void parallel_for_even_chunks(std::size_t n, std::size_t chunk, const Body& body) {
  const std::size_t chunks = (n + chunk - 1) / chunk;
  const auto run = [&](std::size_t c) { body(c * chunk, std::min(n, (c + 1) * chunk)); };
  if (chunks <= 1 || thread_count() == 1) return run_range(run, 0, chunks);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, chunks),
      [&](const auto& range) { run_range(run, range.begin(), range.end()); }, tbb::static_partitioner());
}

/// Sum of term(i) over [0, n), independent of the number of threads. T needs `+=` and a value-initialized zero.
template <class T, class Term>
T ordered_sum(std::size_t n, const Term& term, std::size_t chunk = 1024, T zero = T{}) {
  const std::size_t chunks = (n + chunk - 1) / chunk;
  std::vector<T> partial(chunks, zero);
  parallel_for_chunks(n, chunk, [&](std::size_t first, std::size_t last) {
    T sum = zero;
    for (std::size_t i = first; i < last; ++i) sum += term(i);
    partial[first / chunk] = sum;
  });
  T total = zero;
  for (const T& p : partial) total += p;
  return total;
}

}  // namespace lahar
