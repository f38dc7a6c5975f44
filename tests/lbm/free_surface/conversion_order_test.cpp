// What a step computes depends on neither the number of threads nor the history of the blocks.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/memory_archive.h"
#include "core/parallel.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// A dam break with a pillar in its way: splash, drops, isolated liquid; open at the far end.
FluidOptions dam() {
  FluidOptions o = tank_options(Vec3(0.8, 0.32, 0.5), 0.02, 3.0, 0.1);
  o.domain.faces[1] = FaceKind::open;
  o.domain.walls.add({"pillar", SolidCylinder{Vec3(0.45, 0.15, -1), Vec3(0.45, 0.15, 1), 0.047}});
  return o;
}

const std::vector<LiquidRegion> kColumn{{Vec3::Zero(), Vec3(0.2, 0.32, 0.35)}};

/// All state but the handles of blocks, which say where they are stored.
template <class Real>
StoredState state_in_space(Fluid<Real>& fluid) {
  StoredState state = state_of(fluid);
  std::erase_if(state.lists, [](const auto& list) {
    const auto ends_with = [&](std::string_view end) { return std::string_view(list.first).ends_with(end); };
    return ends_with("indices") || ends_with("capacity") || ends_with("birth") || ends_with("births") ||
           ends_with("fastest");
  });
  return state;
}

template <class Real>
StoredState run(Fluid<Real>& fluid, int steps) {
  fluid.fill(kColumn);
  for (int s = 0; s < steps; ++s) fluid.step();
  return state_in_space(fluid);
}

template <class Real>
class ConversionOrder : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(ConversionOrder, Precisions);

TYPED_TEST(ConversionOrder, IsThatOfNoThread) {
  std::vector<StoredState> states;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    Fluid<TypeParam> fluid(dam());
    states.push_back(run(fluid, 700));
    EXPECT_GT(fluid.account().drop_moves, 0);
    EXPECT_GT(fluid.account().pooled_total, 0);
  }
  for (const StoredState& state : states)
    EXPECT_TRUE(differing_lists(states[0], state).empty()) << testing::PrintToString(differing_lists(states[0], state));
}

TYPED_TEST(ConversionOrder, IsThatOfNoHistory) {
  Fluid<TypeParam> plain(dam()), recycled(dam());
  // Blocks made in another order, of which some are left over and dry: storage and indices are handed out anew.
  auto& grid = recycled.grid();
  for (int k = 0; k < 60; ++k) grid.require_block(Vec3i(k * 7 % 5, k * 11 % 3, k * 13 % 4));
  const std::vector<BlockIndex> made(grid.owned());
  for (std::size_t k = 0; k < made.size(); ++k)
    if (k % 3 != 1) grid.release(made[made.size() - 1 - k]);
  const StoredState expected = run(plain, 701), state = run(recycled, 701);
  EXPECT_NE(plain.grid().owned(), recycled.grid().owned());
  EXPECT_TRUE(differing_lists(expected, state).empty()) << testing::PrintToString(differing_lists(expected, state));
  EXPECT_EQ(plain.mass_drift(), recycled.mass_drift());
}

}  // namespace
}  // namespace lahar::lbm
