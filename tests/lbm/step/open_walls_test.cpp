// A gate that is taken away while liquid stands behind it.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "core/memory_archive.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

constexpr double kOpening = 0.1;  // s

FluidOptions tank(bool gate, WallSlip slip = WallSlip::no_slip) {
  FluidOptions o = tank_options(Vec3(0.8, 0.16, 0.5), 0.02, 3.0, 0.1);
  o.smagorinsky = 0.1;
  o.domain.slip = slip;
  if (!gate) return o;
  Wall wall{"gate", SolidBox{Vec3(0.3, -1, -1), Vec3(0.36, 1, 1)}, slip};
  wall.opens_at = kOpening;
  o.domain.walls.add(wall);
  return o;
}

const std::vector<LiquidRegion> kColumn{{Vec3::Zero(), Vec3(0.3, 0.16, 0.253)}};

/// Steps until the gate has been open for so many steps.
template <class Real>
void run_past_opening(Fluid<Real>& fluid, int steps) {
  bool open = false;
  while (!open) {
    fluid.step();
    open = fluid.open_walls_by(fluid.time());
  }
  for (int s = 0; s < steps; ++s) fluid.step();
}

template <class Real>
double largest_x(const Fluid<Real>& fluid) {
  double x = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) { x = std::max(x, c.centre.x()); });
  return x;
}

template <class Real>
Vec3 centre_of_mass(const Fluid<Real>& fluid) {
  Vec3 sum = Vec3::Zero();
  double volume = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) { sum += c.liquid_volume * c.centre, volume += c.liquid_volume; });
  return sum / volume;
}

/// The column stands until then; from then on it collapses as one that was never held, and no liquid is lost.
TEST(OpenWalls, ColumnCollapsesAsIfItHadNotBeenHeld) {
  for (const WallSlip slip : {WallSlip::no_slip, WallSlip::free_slip}) {
    Fluid<double> held(tank(true, slip)), free(tank(false, slip));
    held.fill(kColumn), free.fill(kColumn);
    while (held.time() < 0.9 * kOpening) {
      held.step();
      EXPECT_FALSE(held.open_walls_by(held.time()));
    }
    EXPECT_LT(largest_x(held), 0.3);
    EXPECT_LT(largest_speed(held), 1e-3);
    const Vec3 start = centre_of_mass(held);
    const double mass = held.liquid_mass();
    run_past_opening(held, 200);
    for (int s = 0; s < 200; ++s) free.step();
    EXPECT_GT(largest_x(held), 0.4);
    EXPECT_NEAR(held.liquid_mass() / mass, 1, 1e-12);
    const Vec3 moved = centre_of_mass(free) - start, ours = centre_of_mass(held) - start;
    EXPECT_GT(moved.norm(), 0.02);
    EXPECT_LT((ours - moved).norm(), 0.01 * moved.norm());
  }
}

/// What was stored after the gate has opened goes on with the same bits.
TEST(OpenWalls, GoesOnAfterTheOpening) {
  Fluid<float> whole(tank(true)), resumed(tank(true));
  whole.fill(kColumn);
  run_past_opening(whole, 37);
  StoredState state = state_of(whole);
  load_state(state, resumed);
  EXPECT_FALSE(resumed.open_walls_by(resumed.time())) << "it is open already";
  for (int s = 0; s < 100; ++s) whole.step(), resumed.step();
  EXPECT_TRUE(differing_lists(state_of(whole), state_of(resumed)).empty());
}

/// A gate that is lifted is a stack of its positions: what it leaves to the next one it bears no more, and what is
/// stored after that goes on with the same bits.
TEST(OpenWalls, TheNextPositionBearsTheLoad) {
  const auto make = [] {
    FluidOptions o = tank(true);
    o.domain.walls.add({"higher", SolidBox{Vec3(0.3, -1, 0.06), Vec3(0.36, 1, 1)}});
    auto fluid = std::make_unique<Fluid<float>>(o);
    fluid->measure_walls();
    return fluid;
  };
  const auto whole = make(), resumed = make();
  whole->fill(kColumn);
  run_past_opening(*whole, 0);
  const double before = whole->wall_loads()[0].impulse.x(), higher = whole->wall_loads()[1].impulse.x();
  EXPECT_GT(before, 0);
  whole->step();
  StoredState state = state_of(*whole);
  load_state(state, *resumed);
  for (int s = 0; s < 30; ++s) whole->step(), resumed->step();
  EXPECT_EQ(whole->wall_loads()[0].impulse.x(), before);
  EXPECT_GT(whole->wall_loads()[1].impulse.x(), higher);
  EXPECT_TRUE(differing_lists(state_of(*whole), state_of(*resumed)).empty());
}

/// Beside a gate an inflow has columns at a wall. When that has gone, also while all is dry, it has those of a tank
/// without it, and whether the state was stored or loaded on the way makes no difference.
TEST(OpenWalls, InflowsLookAgain) {
  const auto make = [](bool gate) {
    FluidOptions o = tank(gate);
    o.inflows.push_back({"in", Vec3(0.36, 0, 0), Vec3(0.46, 0.16, 0.1), Vec3(0.5, 0, 0),
                         Hydrograph{{{0.12, 0}, {0.15, 2e-3}, {1, 2e-3}}}});
    return std::make_unique<Fluid<float>>(o);
  };
  const auto advance = [](Fluid<float>& fluid, double until) {
    while (fluid.time() < until) fluid.step(), fluid.open_walls_by(fluid.time());
  };
  const auto none = make(false), opened = make(true), stored = make(true), loaded = make(true);
  for (const auto* fluid : {&none, &opened, &stored}) advance(**fluid, 0.15);
  StoredState state = state_of(*stored);
  load_state(state, *loaded);
  for (const auto* fluid : {&none, &opened, &stored, &loaded}) advance(**fluid, 0.3);
  EXPECT_GT(opened->inflow_mass(), 0);
  EXPECT_TRUE(differing_lists(state_of(*opened), state_of(*stored)).empty());
  EXPECT_TRUE(differing_lists(state_of(*opened), state_of(*loaded)).empty());
  EXPECT_EQ(centre_of_mass(*opened), centre_of_mass(*none));
}

}  // namespace
}  // namespace lahar::lbm
