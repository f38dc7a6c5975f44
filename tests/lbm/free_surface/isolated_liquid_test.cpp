#include "lbm/free_surface/isolated_liquid.h"

#include <gtest/gtest.h>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// A level pool: one layer of interface cells, 0.3 full.
class IsolatedLiquid : public testing::Test {
 protected:
  IsolatedLiquid() : fluid_(tank_options(Vec3(0.4, 0.4, 0.2), 0.02, 3.0)) {
    fluid_.fill({{Vec3::Zero(), Vec3(0.4, 0.4, 0.106)}});
    for (const BlockIndex b : fluid_.grid().owned())
      if (fluid_.grid().has_surface(b)) blocks_.push_back(b);
  }
  [[nodiscard]] std::vector<double> masses() {
    std::vector<double> all;
    for (const BlockIndex b : blocks_) {
      const auto& surface = *fluid_.grid().block(b).surface;
      for (int c = 0; c < surface.count; ++c) all.push_back(surface.mass[surface.cells[static_cast<std::size_t>(c)]]);
    }
    return all;
  }
  /// Most that one cell got or gave; `sum` is what all together got.
  double pay(double pool, std::uint64_t round, double& sum) {
    const auto before = masses();
    sum = pay_isolated_liquid(fluid_.grid(), blocks_, pool, round);
    const auto after = masses();
    double most = 0, all = 0;
    for (std::size_t k = 0; k < after.size(); ++k) {
      most = std::max(most, std::abs(after[k] - before[k]));
      all += after[k] - before[k];
      touched_[k] = touched_[k] || after[k] != before[k];
    }
    EXPECT_NEAR(all, sum, 1e-12);
    return most;
  }

  Fluid<double> fluid_;
  std::vector<BlockIndex> blocks_;
  std::array<bool, 400> touched_{};
};

TEST_F(IsolatedLiquid, IsPaidInSmallDoses) {
  ASSERT_EQ(masses().size(), 400U);
  double sum = 0;
  EXPECT_NEAR(pay(0.5, 3, sum), 0.02, 1e-15);
  EXPECT_NEAR(sum, 0.5, 1e-12);
  EXPECT_NEAR(pay(-0.5, 4, sum), 0.02, 1e-15);
  EXPECT_NEAR(sum, -0.5, 1e-12);
}

TEST_F(IsolatedLiquid, WaitsWhereThereIsNoRoom) {
  double sum = 0;
  EXPECT_NEAR(pay(20, 5, sum), 0.02, 1e-15);
  EXPECT_NEAR(sum, 400 * 0.02, 1e-11);
}

TEST_F(IsolatedLiquid, TakesNoMoreThanACellHas) {
  for (const BlockIndex b : blocks_) {
    auto& surface = *fluid_.grid().block(b).surface;
    for (int c = 0; c < surface.count; ++c) surface.mass[surface.cells[static_cast<std::size_t>(c)]] = 0.001 * (c % 2);
  }
  double sum = 0, all = 0;
  for (const double mass : masses()) all += mass;
  EXPECT_NEAR(pay(-20, 5, sum), 0.001, 1e-15);
  EXPECT_NEAR(sum, -all, 1e-11);
  for (const double mass : masses()) EXPECT_NEAR(mass, 0, 1e-15);
}

/// A small pool begins at another cell in every round: nobody is always first.
TEST_F(IsolatedLiquid, GoesRound) {
  double sum = 0;
  for (std::uint64_t round = 0; round < 1200; ++round) pay(0.02, round, sum);
  EXPECT_EQ(std::count(touched_.begin(), touched_.end(), true), 400);
}

}  // namespace
}  // namespace lahar::lbm
