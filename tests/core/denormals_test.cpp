#include "core/denormals.h"

#include <gtest/gtest.h>

#include <limits>

namespace lahar {
namespace {

// volatile: the division must happen in the processor, not in the compiler.
[[maybe_unused]] float half_of_the_smallest_normal() {
  volatile float smallest = std::numeric_limits<float>::min();
  volatile float half = smallest / 2;
  return half;
}

TEST(FlushDenormals, ActsWhileItLivesAndNoLonger) {
#if !defined(__SSE2__)
  const FlushDenormals flush;  // does nothing, and is no unused variable
  GTEST_SKIP() << "flushing is set through SSE2";
#else
  EXPECT_GT(half_of_the_smallest_normal(), 0);
  {
    const FlushDenormals flush;
    EXPECT_EQ(half_of_the_smallest_normal(), 0);
  }
  EXPECT_GT(half_of_the_smallest_normal(), 0);
#endif
}

}  // namespace
}  // namespace lahar
