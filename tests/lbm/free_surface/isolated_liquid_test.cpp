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

/// What is paid at once.
class NearbyLiquid : public IsolatedLiquid {
 protected:
  [[nodiscard]] double mass_in(BlockIndex b) {
    const auto& surface = *fluid_.grid().block(b).surface;
    double sum = 0;
    for (int c = 0; c < surface.count; ++c) sum += surface.mass[surface.cells[static_cast<std::size_t>(c)]];
    return sum;
  }
  /// Pays what one block owes; returns what the pool got. What each of `blocks_` was paid is in `paid_`.
  double pay_in(const Vec3i& coordinate, double mass) {
    auto& grid = fluid_.grid();
    std::vector<double> liquid(grid.topology().capacity(), 0.0), before;
    liquid[static_cast<std::size_t>(grid.topology().find(coordinate))] = mass;
    for (const BlockIndex b : blocks_) before.push_back(mass_in(b));
    const LiquidAccount account = fluid_.account();
    pay_nearby(grid, liquid, fluid_.account());
    paid_.clear();
    double all = 0;
    for (std::size_t k = 0; k < blocks_.size(); ++k) all += paid_.emplace_back(mass_in(blocks_[k]) - before[k]);
    const double rest = fluid_.account().pool - account.pool;
    EXPECT_NEAR(all + rest, mass, 1e-11);
    EXPECT_NEAR(fluid_.account().paid_nearby - account.paid_nearby, std::abs(all), 1e-11);
    EXPECT_NEAR(fluid_.account().pooled_total - account.pooled_total, std::abs(rest), 1e-11);
    return rest;
  }
  [[nodiscard]] double paid_at(const Vec3i& coordinate) const {
    const BlockIndex b = fluid_.grid().topology().find(coordinate);
    return paid_[static_cast<std::size_t>(std::find(blocks_.begin(), blocks_.end(), b) - blocks_.begin())];
  }

  /// What a block can take, or give, in a step.
  [[nodiscard]] double line(const Vec3i& coordinate) {
    return 0.02 * fluid_.grid().block(fluid_.grid().topology().find(coordinate)).surface->count;
  }
  std::vector<double> paid_;
};

TEST_F(NearbyLiquid, GoesToItsOwnBlockInEqualParts) {
  const auto before = masses();
  const double all = line({0, 0, 0});
  EXPECT_NEAR(pay_in({0, 0, 0}, all / 2), 0, 1e-12);
  EXPECT_NEAR(paid_at({0, 0, 0}), all / 2, 1e-12);
  const auto after = masses();
  for (std::size_t k = 0; k < after.size(); ++k) {
    const double gain = after[k] - before[k];
    EXPECT_NEAR(gain, gain == 0 ? 0 : 0.01, 1e-12);
  }
}

/// The tank has 3 x 3 blocks.
TEST_F(NearbyLiquid, GoesToTheBlocksAroundWhereItsOwnIsFullAndThenToThePool) {
  const std::array beside{Vec3i(1, 0, 0), Vec3i(0, 1, 0), Vec3i(1, 1, 0)};
  const double own = line({0, 0, 0}), around = line(beside[0]) + line(beside[1]) + line(beside[2]);
  EXPECT_NEAR(pay_in({0, 0, 0}, own + 0.2 * around), 0, 1e-12);
  EXPECT_NEAR(paid_at({0, 0, 0}), own, 1e-12);
  for (const Vec3i& b : beside) EXPECT_NEAR(paid_at(b), 0.2 * line(b), 1e-12);
  EXPECT_EQ(paid_at({2, 0, 0}), 0);
  EXPECT_NEAR(pay_in({0, 0, 0}, -own - around - 1), -1, 1e-11);
  EXPECT_NEAR(paid_at({0, 0, 0}), -own, 1e-11);
  for (const Vec3i& b : beside) EXPECT_NEAR(paid_at(b), -line(b), 1e-11);
  EXPECT_EQ(paid_at({2, 2, 0}), 0);
}

TEST_F(NearbyLiquid, OfABlockWithoutSurfaceGoesToThoseAround) {
  auto& grid = fluid_.grid();
  grid.require_block({1, 1, 1});  // gas, above the middle of the tank
  ASSERT_FALSE(grid.has_surface(grid.topology().find({1, 1, 1})));
  EXPECT_NEAR(pay_in({1, 1, 1}, 1), 0, 1e-12);
  for (const Vec3i& under : {Vec3i(0, 0, 0), Vec3i(1, 1, 0), Vec3i(2, 1, 0)})
    EXPECT_NEAR(paid_at(under), line(under) / (400 * 0.02), 1e-12);
}

TEST_F(NearbyLiquid, LeavesCoveredFullAndEmptyCellsAlone) {
  auto& grid = fluid_.grid();
  const BlockIndex b = grid.topology().find({0, 0, 0});
  BodyFields<double>& body = grid.require_body(b);
  auto& surface = *grid.block(b).surface;
  const std::array<int, 3> cells{surface.cells[0], surface.cells[1], surface.cells[2]};
  body.covered[static_cast<std::size_t>(cells[0] / 8)] |= static_cast<std::uint8_t>(1 << cells[0] % 8);
  surface.mass[cells[1]] = 1 + surface.density[cells[1]] + 0.005;
  surface.mass[cells[2]] = 0;
  const double covered = surface.mass[cells[0]], full = surface.mass[cells[1]];
  EXPECT_NEAR(pay_in({0, 0, 0}, -0.1), 0, 1e-12);
  EXPECT_EQ(surface.mass[cells[0]], covered);
  EXPECT_EQ(surface.mass[cells[2]], 0);
  EXPECT_LT(surface.mass[cells[1]], full);
  surface.mass[cells[1]] = full;
  EXPECT_NEAR(pay_in({0, 0, 0}, 0.1), 0, 1e-12);
  EXPECT_EQ(surface.mass[cells[0]], covered);
  EXPECT_EQ(surface.mass[cells[1]], full);
  EXPECT_GT(surface.mass[cells[2]], 0);
}

/// A debt and an excess side by side: neither reaches beyond the blocks around its own.
TEST_F(NearbyLiquid, IsMirroredWhereItsBlocksAre) {
  auto& grid = fluid_.grid();
  std::vector<double> liquid(grid.topology().capacity(), 0.0);
  const auto at = [&](const Vec3i& c) -> double& { return liquid[static_cast<std::size_t>(grid.topology().find(c))]; };
  at({0, 1, 0}) = at({1, 0, 0}) = 1.5 * line({1, 0, 0}), at({0, 0, 0}) = -1.4 * line({0, 0, 0});
  pay_nearby(grid, liquid, fluid_.account());
  for (const auto& [x, y] : {std::pair{1, 0}, std::pair{2, 0}, std::pair{2, 1}}) {
    const double here = mass_in(grid.topology().find({x, y, 0})), there = mass_in(grid.topology().find({y, x, 0}));
    EXPECT_NEAR(here, there, 1e-12) << x << " " << y;
  }
}

/// A small pool begins at another cell in every round: nobody is always first.
TEST_F(IsolatedLiquid, GoesRound) {
  double sum = 0;
  for (std::uint64_t round = 0; round < 1200; ++round) pay(0.02, round, sum);
  EXPECT_EQ(std::count(touched_.begin(), touched_.end(), true), 400);
}

}  // namespace
}  // namespace lahar::lbm
