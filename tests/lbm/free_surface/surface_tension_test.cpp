#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/parallel.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// A cube of liquid in lattice units becomes a ball of the pressure 2 sigma / R. It may have moved meanwhile: the edges
/// of a cube that does not lie on the lattice are not resolved alike.
TEST(SurfaceTension, ACubeBecomesABall) {
  FluidOptions o = lattice_options(Vec3i::Constant(24), 0.1);
  o.domain.faces.fill(FaceKind::open);
  o.surface_tension = 0.01;
  for (const Vec3& start : {Vec3(12, 12, 12), Vec3(12.2, 12.1, 11.9)}) {
    Fluid<double> fluid(o);
    fluid.fill({{start - Vec3::Constant(5), start + Vec3::Constant(5)}});
    for (int s = 0; s < 1000; ++s) fluid.step();
    const double radius = std::cbrt(3 * 1000 / (4 * std::numbers::pi));  // 6.2
    Vec3 centre = Vec3::Zero();
    fluid.for_each_wet_cell([&](const WetCell& c) { centre += c.liquid_volume / 1000 * c.centre; });
    double least = 1e9, most = 0;
    fluid.for_each_wet_cell([&](const WetCell& c) {
      if (c.fill_level < 0.3 || c.fill_level > 0.7) return;
      least = std::min(least, (c.centre - centre).norm());
      most = std::max(most, (c.centre - centre).norm());
    });
    EXPECT_GT(least, radius - 0.8);  // half a cell's diagonal
    EXPECT_LT(most, radius + 0.8);   // the corners of the cube are 8.7 away
    EXPECT_LT((centre - start).norm(), 2);
    EXPECT_NEAR(fluid.cell_at(centre)->pressure, 2 * 0.01 / radius, 0.05 * 2 * 0.01 / radius);
    EXPECT_LT(std::abs(fluid.mass_drift()), 1e-10);
  }
}

/// Water at 2 mm: the surface breaks up with ripples on it.
template <class Real>
std::pair<double, std::vector<double>> dam_break(int threads) {
  const ThreadLimit limit(threads);
  FluidOptions o = tank_options(Vec3(0.06, 0.016, 0.05), 0.002, 0.8, 0.1);
  o.surface_tension = 0.0728;
  Fluid<Real> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.02, 0.016, 0.03)}});
  for (int s = 0; s < 2000; ++s) fluid.step();
  std::vector<double> fill;
  fluid.for_each_wet_cell([&](const WetCell& c) { fill.push_back(c.fill_level); });
  return {fluid.mass_drift(), fill};
}

TEST(SurfaceTension, DamBreakKeepsItsMassOnAnyNumberOfThreads) {
  const auto one = dam_break<double>(1), two = dam_break<double>(2);
  EXPECT_LT(std::abs(one.first), 1e-10);
  EXPECT_EQ(one.second, two.second);
  EXPECT_LT(std::abs(dam_break<float>(1).first), 1e-6);
}

TEST(SurfaceTension, RefusesAStepThatRipplesOutrun) {
  FluidOptions o = tank_options(Vec3(0.06, 0.016, 0.05), 0.002, 0.8, 0.1);
  o.time_step = 3.0e-3;  // sqrt(1000 0.002^3 / (4 pi 0.0728)) = 2.957e-3 s
  o.surface_tension = 0.0728;
  EXPECT_THROW(Fluid<double>{o}, std::logic_error);
  o.time_step = 2.9e-3;
  EXPECT_NO_THROW(Fluid<double>{o});
}

}  // namespace
}  // namespace lahar::lbm
