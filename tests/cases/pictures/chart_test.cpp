#include "cases/pictures/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lahar::cases {
namespace {

// Columns in which a clearly blue (first line) pixel occurs, and the mean row of them.
struct Trace {
  std::vector<int> columns;
  std::vector<double> rows;
};

Trace blue_trace(const Image& image) {
  Trace trace;
  for (int x = 0; x < image.width(); ++x) {
    double sum = 0, count = 0;
    for (int y = 90; y < image.height(); ++y) {
      const Colour& c = image.at(x, y);
      if (c.z() - c.x() > 0.25F) sum += y, ++count;
    }
    if (count > 0) trace.columns.push_back(x), trace.rows.push_back(sum / count);
  }
  return trace;
}

TEST(Chart, TicksAreRoundAndCoverTheRange) {
  EXPECT_EQ(chart_ticks(0, 4, 8), (std::vector<double>{0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4}));
  const std::vector<double> ticks = chart_ticks(-13, 71, 5);
  EXPECT_EQ(ticks, (std::vector<double>{-20, 0, 20, 40, 60, 80}));
  EXPECT_THROW((void)chart_ticks(1, 1, 5), std::logic_error);
}

TEST(Chart, AStraightLineIsStraightAndRises) {
  const std::vector<ChartLine> lines{{"force", {0, 10}, {0, 100}}};
  const Trace trace = blue_trace(draw_chart(lines, {"", "x", "y"}));
  ASSERT_GT(trace.columns.size(), 700U);
  const std::size_t last = trace.columns.size() - 20, middle = trace.columns.size() / 2;
  const double slope = (trace.rows[last] - trace.rows[20]) / (trace.columns[last] - trace.columns[20]);
  EXPECT_LT(slope, -0.3) << "up is towards row 0";
  EXPECT_NEAR(trace.rows[middle], trace.rows[20] + slope * (trace.columns[middle] - trace.columns[20]), 1.0);
}

TEST(Chart, MissingValuesLeaveAGap) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<ChartLine> whole{{"", {0, 1, 2, 3, 4}, {1, 1, 1, 1, 1}}};
  const std::vector<ChartLine> holed{{"", {0, 1, 2, 3, 4}, {1, 1, nan, 1, 1}}};
  const auto all = static_cast<double>(blue_trace(draw_chart(whole, {})).columns.size());
  const auto rest = static_cast<double>(blue_trace(draw_chart(holed, {})).columns.size());
  EXPECT_NEAR(rest / all, 0.5, 0.03);
}

TEST(Chart, WorksWithoutDataAndRefusesMisuse) {
  EXPECT_TRUE(blue_trace(draw_chart({}, {"nothing", "x", "y"})).columns.empty());
  EXPECT_THROW((void)draw_chart(std::vector<ChartLine>{{"", {0, 1}, {0}}}, {}), std::logic_error);
  EXPECT_THROW((void)draw_chart({}, {.width = 20}), std::logic_error);
}

}  // namespace
}  // namespace lahar::cases
