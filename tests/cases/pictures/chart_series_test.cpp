#include "cases/pictures/chart_series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lahar::cases {
namespace {

ChartFrame unit_frame(AxisScale y = AxisScale::linear) {
  ChartFrame frame;
  frame.box = PlaneBox(Point(0, 0), Point(100, 100));
  frame.y.scale = y;
  if (y == AxisScale::logarithmic) frame.y.low = 0.01;
  return frame;
}

TEST(ChartSeries, LooksDiffer) {
  const std::vector<ChartSeries> series{
      {}, {.mark = Mark::points}, {.dash = Dash::dotted, .colour = ChartColour::black}, {.mark = Mark::points}};
  const auto looks = looks_of(series);
  EXPECT_GT((looks[0].pen.colour - looks[1].pen.colour).norm(), 0.3F);
  EXPECT_LT(looks[2].pen.colour.maxCoeff(), 0.2F);
  EXPECT_FALSE(looks[2].pen.dashes.empty());
  EXPECT_NE(looks[1].shape, looks[3].shape);
}

/// A case keeps its look from chart to chart, whatever else is shown.
TEST(ChartSeries, APointShapeMayBeChosen) {
  const ChartSeries chosen{.mark = Mark::points, .colour = ChartColour::green, .shape = PointShape::diamond};
  const auto alone = looks_of(std::vector<ChartSeries>{chosen});
  const auto last = looks_of(std::vector<ChartSeries>{{.mark = Mark::points}, {.mark = Mark::points}, chosen});
  EXPECT_EQ(alone[0].shape, PointShape::diamond);
  EXPECT_EQ(last[2].shape, PointShape::diamond);
}

TEST(ChartSeries, ThinningKeepsEndsAndExtremes) {
  std::vector<Point> noise;
  for (int n = 0; n < 1000; ++n) noise.emplace_back(0.001F * static_cast<float>(n), std::sin(static_cast<float>(n)));
  noise[437].y() = 9, noise[612].y() = -9;
  const auto kept = thinned(noise, 0.1F);
  EXPECT_LE(kept.size(), 44U);
  EXPECT_EQ(kept.front(), noise.front());
  EXPECT_EQ(kept.back(), noise.back());
  EXPECT_TRUE(std::find(kept.begin(), kept.end(), noise[437]) != kept.end());
  EXPECT_TRUE(std::find(kept.begin(), kept.end(), noise[612]) != kept.end());
  for (std::size_t n = 1; n < kept.size(); ++n) EXPECT_LT(kept[n - 1].x(), kept[n].x()) << "order or a double";
  const std::vector<Point> sparse{{0, 0}, {5, 1}, {3, 2}};
  EXPECT_EQ(thinned(sparse, 0.1F), sparse);
}

TEST(ChartSeries, CurvesBreakWhereAnAxisCannotShow) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ChartSeries s{.x = {0, 0.2, 0.4, 0.6, 0.8, 1}, .y = {1, 1, nan, 1, -1, 1}};
  EXPECT_EQ(curves_of(s, unit_frame()).size(), 2U);
  EXPECT_EQ(curves_of(s, unit_frame(AxisScale::logarithmic)).size(), 3U);
}

TEST(ChartSeries, OccupiesWhatItCovers) {
  Occupancy taken;
  occupy(taken, {.x = {0.5}, .y = {0.5}, .mark = Mark::points, .error = {0.3}}, unit_frame());
  EXPECT_FALSE(taken.is_free({Point(45, 75), Point(55, 90)})) << "the bar";
  EXPECT_TRUE(taken.is_free({Point(60, 40), Point(90, 60)}));
  occupy(taken, {.x = {0, 1}, .y = {0.4, 0.4}}, unit_frame());
  EXPECT_FALSE(taken.is_free({Point(60, 40), Point(90, 61)})) << "the line";
}

}  // namespace
}  // namespace lahar::cases
