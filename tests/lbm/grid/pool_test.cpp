#include "lbm/grid/pool.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace lahar::lbm {
namespace {

/// Counts what is made and destroyed.
struct alignas(64) Counted {
  static inline int alive = 0;
  Counted() { ++alive; }
  ~Counted() { --alive; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  double numbers[10000] = {};
};

TEST(ObjectPool, HandsOutWhatCameBack) {
  {
    ObjectPool<Counted> pool;
    EXPECT_EQ(pool.bytes(), 0u);
    std::set<Counted*> seen;
    for (int k = 0; k < 60; ++k) {
      Counted* const p = pool.acquire();
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(p) % 64, 0u);
      EXPECT_EQ(p->numbers[9999], 0);
      p->numbers[0] = k;
      EXPECT_TRUE(seen.insert(p).second) << "handed out twice";
    }
    const std::size_t bytes = pool.bytes();
    EXPECT_GE(bytes, 60 * sizeof(Counted));
    EXPECT_GE(Counted::alive, 60);
    Counted* const back = *seen.begin();
    pool.release(back);
    EXPECT_EQ(pool.acquire(), back);
    EXPECT_EQ(pool.bytes(), bytes) << "no more than is in use";
  }
  EXPECT_EQ(Counted::alive, 0);
}

TEST(PopulationPool, KeepsBlocksApart) {
  PopulationPool<float> pool;
  std::set<float*> seen;
  for (int b = 0; b < 200; ++b) {
    float* const p = pool.acquire();
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(p) % 64, 0u);
    EXPECT_TRUE(seen.insert(p).second);
    for (std::size_t i = 0; i < 19; ++i)
      for (std::size_t n = 0; n < 512; n += 511) p[i * PopulationPool<float>::stride + n] = static_cast<float>(b);
  }
  std::set<float> kept;
  for (float* p : seen) {
    EXPECT_EQ(p[0], p[18 * PopulationPool<float>::stride + 511]);
    kept.insert(p[0]);
  }
  EXPECT_EQ(kept.size(), 200u) << "each block still has its own numbers";
}

}  // namespace
}  // namespace lahar::lbm
