#include "dem/bonds/axial_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lahar::dem {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Li, Zhao & Kwan (2020), Table 2.
AxialLaw table2(bool plastic = false) { return {{3.7e10, 1.2e8, 1.9e9}, {78.0e3, 98.2e3}, plastic}; }
const double kArea = std::numbers::pi * 0.01 * 0.01;

TEST(AxialLaw, OrdinaryBondIsALine) {
  const AxialCurve c = axial_curve({{2e9, 0, 0}}, 1e-4);
  EXPECT_TRUE(c.linear());
  EXPECT_DOUBLE_EQ(curve_force(c, 3e-3), 600);
  EXPECT_DOUBLE_EQ(curve_force(c, -3e-3), -600);
  EXPECT_DOUBLE_EQ(curve_energy(c, -3e-3), 0.9);
}

TEST(AxialLaw, FollowsTable2) {
  const AxialCurve c = axial_curve(table2(), kArea);
  const double e1 = 78e3 / (3.7e10 * kArea), e2 = e1 + 20.2e3 / (1.2e8 * kArea), e3 = e2 + 162.8e3 / (1.9e9 * kArea);
  EXPECT_DOUBLE_EQ(curve_force(c, -e1), -78e3);  // compression on the first branch
  EXPECT_DOUBLE_EQ(curve_force(c, e1 / 2), 39e3);
  EXPECT_DOUBLE_EQ(curve_force(c, e1), 78e3);
  EXPECT_DOUBLE_EQ(curve_force(c, (e1 + e2) / 2), 88.1e3);
  EXPECT_DOUBLE_EQ(curve_force(c, e2), 98.2e3);
  EXPECT_DOUBLE_EQ(curve_force(c, e3), 261e3);
}

TEST(AxialLaw, EnergyIsTheAreaUnderTheCurve) {
  const AxialCurve c = axial_curve(table2(), kArea);
  const double end = 1.2 * (c.e1 + c.width);
  const int n = 200000;
  double area = 0;
  for (int k = 0; k < n; ++k) area += curve_force(c, end * (k + 0.5) / n) * end / n;
  EXPECT_NEAR(curve_energy(c, end) / area, 1, 1e-8);
}

TEST(AxialLaw, WireThatOnlyPullsGoesSlack) {
  for (const bool plastic : {false, true}) {
    AxialLaw law = table2(plastic);
    law.tension_only = true;
    const AxialCurve c = axial_curve(law, kArea), pushed = axial_curve(table2(plastic), kArea);
    EXPECT_FALSE(c.linear());
    EXPECT_EQ(curve_force(c, -1e-3), 0);
    EXPECT_EQ(curve_energy(c, -1e-3), 0);
    EXPECT_DOUBLE_EQ(curve_force(c, 1.5 * c.e1), curve_force(pushed, 1.5 * c.e1));
    const PlasticStep loaded = plastic_step(c, c.e1 + 0.5 * c.width, 0);
    EXPECT_EQ(plastic_step(c, 0.9 * loaded.plastic_elongation, loaded.plastic_elongation).force, 0);
    EXPECT_EQ(plastic_step(c, 0, loaded.plastic_elongation).plastic_elongation, loaded.plastic_elongation);
  }
  AxialLaw line{{2e9, 0, 0}};
  line.tension_only = true;
  EXPECT_FALSE(axial_curve(line, 1e-4).linear());
  EXPECT_DOUBLE_EQ(curve_force(axial_curve(line, 1e-4), 3e-3), 600);
  EXPECT_EQ(curve_force(axial_curve(line, 1e-4), -3e-3), 0);
}

TEST(AxialLaw, BilinearNeverReachesTheThirdBranch) {
  const AxialCurve c = axial_curve({{1e9, 1e7, 0}, {1e3, kInfinity}}, 1e-3);
  EXPECT_DOUBLE_EQ(c.e1, 1e-3);
  EXPECT_DOUBLE_EQ(curve_force(c, 1.001), 1e3 + 1e4);
}

TEST(AxialLaw, PlasticUnloadingRunsDownTheFirstStiffnessAndBack) {
  const AxialCurve c = axial_curve(table2(true), kArea);
  const double far = c.e1 + 0.5 * c.width;
  const PlasticStep loaded = plastic_step(c, far, 0);
  EXPECT_DOUBLE_EQ(loaded.force, 88.1e3);
  const double p = loaded.plastic_elongation;
  EXPECT_NEAR(p, far - 88.1e3 / c.k1, 1e-12);
  for (const double force : {60e3, 0.0, 88e3}) {  // unloading, slack, reloading
    const PlasticStep s = plastic_step(c, p + force / c.k1, p);
    EXPECT_NEAR(s.force, force, 1e-6);
    EXPECT_EQ(s.plastic_elongation, p);
  }
  EXPECT_GT(plastic_step(c, far + 1e-3, p).plastic_elongation, p);
  for (const auto& [elongation, force] : {std::pair{0.5 * p, 0.0}, {0.0, 0.0}, {-1e-4, -1e-4 * c.k1}}) {
    const PlasticStep s = plastic_step(c, elongation, p);  // slack, slack, pushed together
    EXPECT_EQ(s.force, force);
    EXPECT_EQ(s.plastic_elongation, p);
  }
}

TEST(AxialLaw, PlasticWorkClosesTheLoop) {
  const AxialCurve c = axial_curve(table2(true), kArea);
  for (const double share : {0.3, 1.0, 1.5}) {  // in the second branch, at its end, in the third
    const double top = c.e1 + share * c.width;
    double plastic = 0, work = 0, last = 0, e = 0;
    const auto go = [&](double to, int n) {
      const double from = e;
      for (int k = 1; k <= n; ++k) {
        e = from + (to - from) * k / n;
        const PlasticStep s = plastic_step(c, e, plastic);
        work += 0.5 * (s.force + last) * (to - from) / n;
        last = s.force, plastic = s.plastic_elongation;
      }
    };
    go(top, 100000);
    EXPECT_NEAR(work, curve_energy(c, top), 1e-6 * work);
    go(plastic, 10);  // back to no force
    EXPECT_NEAR(last, 0, 1e-4);
    EXPECT_NEAR(plastic_work(c, plastic), work, 1e-6 * work) << share;
  }
}

TEST(AxialLaw, RefusesLawsThatCannotBeFollowed) {
  EXPECT_THROW(axial_curve({{0, 1, 1}}, 1), std::logic_error);
  EXPECT_THROW(axial_curve({{1e9, -1, 1}}, 1), std::logic_error);
  EXPECT_THROW(axial_curve({{1e9, 1e8, 1e8}, {2e3, 1e3}}, 1), std::logic_error);
  EXPECT_THROW(axial_curve({{1e9, 1e8, 2e9}, {1e3, 2e3}, true}, 1), std::logic_error);
  EXPECT_NO_THROW(axial_curve({{1e9, 1e8, 2e9}, {1e3, 2e3}, false}, 1));
}

}  // namespace
}  // namespace lahar::dem
