#include "coupling/under_relaxed_force.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lahar::coupling {
namespace {

TEST(UnderRelaxedForce, HeavyBodiesFeelTheForceItself) {
  EXPECT_EQ(relaxation_factor(4, 1), 1);
  EXPECT_LT(relaxation_factor(3.9, 1), 1);
  Vec3 felt(1, 2, 3);
  under_relax(felt, Vec3(5, 5, 5), relaxation_factor(4, 1), true);
  EXPECT_EQ(felt, Vec3(5, 5, 5));
}

/// Liquid of up to twice what is entrained answers a step late, m a_n = -M a_n-1: the swings of a body that weighs
/// nothing beside it die out.
TEST(UnderRelaxedForce, LateAnswersDieOut) {
  for (const double own : {1e-3, 0.1, 1.0, 3.0}) {
    Vec3 felt = Vec3::Zero();
    double acceleration = 1;
    for (int n = 0; n < 60; ++n) {
      under_relax(felt, Vec3(-2 * acceleration, 0, 0), relaxation_factor(own, 1), true);
      acceleration = felt.x() / own;
    }
    EXPECT_LT(std::abs(acceleration), 1e-9 / own) << own;
  }
}

TEST(UnderRelaxedForce, DryBodiesForget) {
  Vec3 felt(1, 2, 3);
  under_relax(felt, Vec3::Zero(), 0.1, false);
  EXPECT_EQ(felt, Vec3::Zero());
}

}  // namespace
}  // namespace lahar::coupling
