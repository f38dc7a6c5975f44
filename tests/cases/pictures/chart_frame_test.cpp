#include "cases/pictures/chart_frame.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lahar::cases {
namespace {

ChartFrame frame_without_legend(const Chart& chart) {
  Canvas canvas(Canvas::Medium::pixels, chart.width, chart.height);
  return frame_of(chart, canvas, 0);
}

TEST(ChartFrame, LeavesRoomForWhatIsWrittenAround) {
  Chart chart{.series = {{.x = {0, 1}, .y = {0, 1}}}};
  const PlaneBox bare = frame_without_legend(chart).box;
  EXPECT_GT(bare.min().x(), 15) << "numbers of the ticks";
  EXPECT_GT(chart.height - bare.max().y(), 15);
  chart.title = "title";
  EXPECT_GT(frame_without_legend(chart).box.min().y(), bare.min().y() + 10);
  chart.y.label = "force";
  EXPECT_GT(frame_without_legend(chart).box.min().x(), bare.min().x() + 10);
  chart.x.label = "time";
  EXPECT_LT(frame_without_legend(chart).box.max().y(), bare.max().y() - 10);
  chart.series[0].y[1] = 12345;
  chart.y.low = 0, chart.y.high = 9000;
  EXPECT_GT(frame_without_legend(chart).box.min().x(), bare.min().x() + 15) << "wider numbers";
}

TEST(ChartFrame, CoversSeriesBandsBarsAndGuides) {
  Chart chart{.series = {{.x = {0, 1}, .y = {0, 1}},
                         {.x = {0}, .y = {5}, .error = {1.9}},
                         {.x = {0, 2}, .y = {-4, -4}, .mark = Mark::band, .upper = {0, 0}}},
              .x_guides = {{7, ""}},
              .y_guides = {{11, ""}}};
  const ChartFrame frame = frame_without_legend(chart);
  EXPECT_LE(frame.y.low, -4);
  EXPECT_GE(frame.y.high, 11);
  EXPECT_GE(frame.x.high, 7);
  chart.y_guides.clear();
  EXPECT_GE(frame_without_legend(chart).y.high, 6.9);
}

TEST(ChartFrame, ValuesAndPlacesAgree) {
  const ChartFrame frame = frame_without_legend({.series = {{.x = {0, 10}, .y = {0, 4}}}});
  EXPECT_LT((frame.at(0, 0) - Point(frame.box.min().x(), frame.box.max().y())).norm(), 1e-3F);
  EXPECT_LT((frame.at(10, 4) - Point(frame.box.max().x(), frame.box.min().y())).norm(), 1e-3F);
  EXPECT_LT((frame.at(5, 2) - frame.box.center()).norm(), 1e-3F);
  EXPECT_TRUE(frame.shows(10, 4));
  EXPECT_FALSE(frame.shows(10.1, 4));
  EXPECT_FALSE(frame.shows(5, std::nan("")));
}

}  // namespace
}  // namespace lahar::cases
