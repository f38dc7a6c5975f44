#include "cases/pictures/chart_legend.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lahar::cases {
namespace {

struct Placed {
  ChartFrame frame;
  Occupancy taken;
  ChartLegend legend;
};

Placed placed(const Chart& chart) {
  Canvas canvas(Canvas::Medium::pixels, chart.width, chart.height);
  Placed p;
  p.frame = frame_of(chart, canvas, 0);
  for (const ChartSeries& s : chart.series) occupy(p.taken, s, p.frame);
  p.legend = legend_of(chart, canvas, p.frame, p.taken);
  return p;
}

TEST(ChartLegend, FindsTheCornerThatNoCurveUses) {
  const Placed rising = placed({.series = {{.name = "rising", .x = {0, 1}, .y = {0, 1}}}});
  ASSERT_TRUE(rising.legend.ground.has_value());
  EXPECT_TRUE(rising.taken.is_free(*rising.legend.ground));
  EXPECT_TRUE(rising.frame.box.contains(*rising.legend.ground));
  EXPECT_LT(rising.legend.ground->center().x(), rising.frame.box.center().x()) << "upper left";
  const Placed falling = placed({.series = {{.name = "falling", .x = {0, 1}, .y = {1, 0}}}});
  ASSERT_TRUE(falling.legend.ground.has_value());
  EXPECT_GT(falling.legend.ground->center().x(), falling.frame.box.center().x()) << "upper right";
}

TEST(ChartLegend, StandsAboveWhereCurvesAreEverywhere) {
  Chart chart;
  for (int k = 0; k < 6; ++k) {
    ChartSeries s{.name = "a name of some length " + std::to_string(k)};
    for (int n = 0; n < 300; ++n) s.x.push_back(n), s.y.push_back(std::sin(n + k));
    chart.series.push_back(s);
  }
  const Placed p = placed(chart);
  EXPECT_FALSE(p.legend.ground.has_value());
  ASSERT_EQ(p.legend.places.size(), 6U);
  EXPECT_GT(p.legend.places.back().y(), p.legend.places.front().y() + 10) << "more than one row";
  EXPECT_GE(p.frame.box.min().y() + p.legend.above, p.legend.places.back().y() + 5);
  for (const Point& place : p.legend.places) EXPECT_LT(place.x(), p.frame.box.max().x());
}

TEST(ChartLegend, NamesOnlyWhatHasAName) {
  const Placed p = placed({.series = {{.x = {0, 1}, .y = {0, 1}}, {.name = "b", .x = {0, 1}, .y = {0, 1}}}});
  EXPECT_EQ(p.legend.entries, std::vector<std::size_t>{1});
  EXPECT_TRUE(placed({.series = {{.x = {0, 1}, .y = {0, 1}}}}).legend.entries.empty());
}

}  // namespace
}  // namespace lahar::cases
