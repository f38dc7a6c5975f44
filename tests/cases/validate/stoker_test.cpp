// Stoker's bore against its jump conditions and its limits.
#include "cases/validate/free_surface/stoker.h"

#include <gtest/gtest.h>

namespace lahar::validate {
namespace {

TEST(Stoker, KeepsMassAndMomentumAcrossTheBore) {
  for (const double film : {1e-3, 0.02, 0.1, 0.5, 0.9}) {
    const Bore b = stoker(film);
    EXPECT_NEAR(b.speed * (b.depth - film), b.velocity * b.depth, 1e-12) << film;
    EXPECT_NEAR(film * b.speed * b.velocity, 0.5 * (b.depth * b.depth - film * film), 1e-12) << film;
    EXPECT_NEAR(b.velocity + 2 * std::sqrt(b.depth), 2, 1e-12) << film;
  }
}

TEST(Stoker, IsAWaveOnAFullReservoirAndAFrontOnADryBed) {
  const Bore full = stoker(1 - 1e-6);
  EXPECT_NEAR(full.speed, 1, 1e-6);
  EXPECT_NEAR(full.velocity, 0, 1e-6);
  const Bore dry = stoker(1e-12);  // depth behind the bore vanishes as film^(1/3)
  EXPECT_NEAR(dry.velocity, 2, 0.01);
  EXPECT_NEAR(dry.speed, 2, 0.01);
  EXPECT_LT(dry.depth, 1e-4);
}

}  // namespace
}  // namespace lahar::validate
