#include "cases/pictures/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "cases/files/output_file.h"
#include "cases/files/png_file.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::file_text;
using scene::ScratchFolder;

// Columns in which a clearly blue (first series) pixel occurs, and the mean row of them.
struct Trace {
  std::vector<int> columns;
  std::vector<double> rows;
};

Trace blue_trace(const Image& image) {
  Trace trace;
  for (int x = 0; x < image.width(); ++x) {
    double sum = 0, count = 0;
    for (int y = 0; y < image.height(); ++y) {
      const Colour& c = image.at(x, y);
      if (c.z() - c.x() > 0.25F) sum += y, ++count;
    }
    if (count > 0) trace.columns.push_back(x), trace.rows.push_back(sum / count);
  }
  return trace;
}

Chart chart_of(ChartSeries series) { return {.x = {"time", "s"}, .y = {"force", "kN"}, .series = {std::move(series)}}; }

Chart full_chart() {
  Chart chart = chart_of({.name = "measured & \"<ours>\"", .x = {1, 2, 4}, .y = {3, 5, 4}, .mark = Mark::points});
  chart.title = "Everything";
  chart.series[0].error = {0.5, 0.2, 0.1};
  chart.series.push_back({.name = "band", .x = {1, 4}, .y = {2, 3}, .mark = Mark::band, .upper = {4, 6}});
  chart.series.push_back({.name = "line", .x = {1, 4}, .y = {3, 4}, .dash = Dash::dash_dot});
  chart.x_guides = {{3, "here"}}, chart.y_guides = {{5.5, "there"}};
  return chart;
}

TEST(Chart, AStraightLineIsStraightAndRises) {
  const Trace trace = blue_trace(chart_of({.x = {0, 10}, .y = {0, 100}}).image());
  ASSERT_GT(trace.columns.size(), 900U);
  const std::size_t last = trace.columns.size() - 20, middle = trace.columns.size() / 2;
  const double slope = (trace.rows[last] - trace.rows[20]) / (trace.columns[last] - trace.columns[20]);
  EXPECT_LT(slope, -0.3) << "up is towards row 0";
  EXPECT_NEAR(trace.rows[middle], trace.rows[20] + slope * (trace.columns[middle] - trace.columns[20]), 1.0);
}

TEST(Chart, APowerLawIsStraightOnLogarithmicAxes) {
  ChartSeries power;
  for (double x = 1; x < 1e4; x *= 1.3) power.x.push_back(x), power.y.push_back(std::pow(x, -1.5));
  Chart chart = chart_of(power);
  chart.x.scale = chart.y.scale = AxisScale::logarithmic;
  const Trace trace = blue_trace(chart.image());
  const std::size_t last = trace.columns.size() - 20, middle = trace.columns.size() / 2;
  const double slope = (trace.rows[last] - trace.rows[20]) / (trace.columns[last] - trace.columns[20]);
  EXPECT_NEAR(trace.rows[middle], trace.rows[20] + slope * (trace.columns[middle] - trace.columns[20]), 1.0);
}

TEST(Chart, MissingValuesLeaveAGap) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto columns = [](double third) {
    const Chart chart = chart_of({.x = {0, 1, 2, 3, 4}, .y = {1, 1, third, 1, 1}});
    return static_cast<double>(blue_trace(chart.image()).columns.size());
  };
  EXPECT_NEAR(columns(nan) / columns(1), 0.5, 0.03);
}

TEST(Chart, ValuesBeyondGivenEndsAreCutOff) {
  Chart chart = chart_of({.x = {0, 1, 2}, .y = {0, 0, 1}});
  chart.x.high = 1;
  const Trace trace = blue_trace(chart.image());
  EXPECT_LT(trace.columns.back(), 1195);
  EXPECT_LT(std::abs(trace.rows.front() - trace.rows.back()), 8) << "the rise lies outside";
}

TEST(Chart, EveryPartLeavesItsMark) {
  const Chart whole = full_chart();
  const auto ink = [](const Chart& chart) {
    double sum = 0;
    const Image image = chart.image();
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) sum += 3 - static_cast<double>(image.at(x, y).sum());
    return sum;
  };
  const double all = ink(whole);
  Chart less = whole;
  less.series[0].error.clear();
  less.y.low = 1.8, less.y.high = 6.2;
  Chart same = whole;
  same.y = less.y;
  EXPECT_LT(ink(less), ink(same) - 100) << "error bars";
  for (const auto& change : std::vector<void (*)(Chart&)>{
           [](Chart& c) { c.title.clear(); }, [](Chart& c) { c.x.label.clear(); },
           [](Chart& c) { c.series.pop_back(); }, [](Chart& c) { c.series[2].name.clear(); },
           [](Chart& c) { c.x_guides[0].name.clear(); }, [](Chart& c) { c.y_guides.clear(); }}) {
    Chart changed = whole;
    change(changed);
    EXPECT_GT(std::abs(ink(changed) - all), 100);
  }
}

// Rough check of well-formed XML: every tag is closed in order, no stray '<' or '&'.
bool parses_as_xml(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = text.substr(at + 1, end - at - 1);
    at = end;
    if (tag.find('<') != std::string::npos) return false;
    if (tag.starts_with("?") || tag.ends_with("/")) continue;
    if (tag.starts_with("/")) {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    } else {
      open.push_back(tag.substr(0, tag.find_first_of(" \n")));
    }
  }
  return open.empty();
}

TEST(Chart, WritesPictureAndVectorFiles) {
  const ScratchFolder folder;
  const Chart chart = full_chart();
  chart.write_all(folder.path() / "chart.png");
  const Image image = read_png(folder.path() / "chart.png");
  EXPECT_EQ(image.width(), 1200);
  EXPECT_EQ(image.height(), 750);
  EXPECT_EQ(file_text(folder.path() / "chart.png").substr(1, 3), "PNG");
  const std::string svg = file_text(folder.path() / "chart.svg"), pdf = file_text(folder.path() / "chart.pdf");
  EXPECT_TRUE(parses_as_xml(svg));
  EXPECT_NE(svg.find("width=\"400pt\" height=\"250pt\""), std::string::npos);
  EXPECT_TRUE(pdf.starts_with("%PDF-"));
  EXPECT_NE(pdf.find("%%EOF"), std::string::npos);
  EXPECT_THROW(chart.write(folder.path() / "chart.gif"), std::logic_error);
  EXPECT_THROW(chart.write(folder.path() / "missing/chart.svg"), FileError);
}

TEST(Chart, TheSameChartGivesTheSameBytes) {
  const ScratchFolder folder;
  full_chart().write_all(folder.path() / "a.png");
  full_chart().write_all(folder.path() / "b.png");
  for (const std::string ending : {".png", ".svg", ".pdf"})
    EXPECT_TRUE(file_text(folder.path() / ("a" + ending)) == file_text(folder.path() / ("b" + ending))) << ending;
  EXPECT_EQ(file_text(folder.path() / "a.pdf").find("CreationDate"), std::string::npos);
}

TEST(Chart, WorksWithoutDataAndRefusesMisuse) {
  EXPECT_TRUE(blue_trace(Chart{.title = "nothing"}.image()).columns.empty());
  EXPECT_THROW((void)chart_of({.x = {0, 1}, .y = {0}}).image(), std::logic_error);
  EXPECT_THROW((void)chart_of({.x = {0}, .y = {0}, .error = {1, 2}}).image(), std::logic_error);
  EXPECT_THROW((void)chart_of({.x = {0}, .y = {0}, .mark = Mark::band}).image(), std::logic_error);
  EXPECT_THROW((void)Chart{.width = 20}.image(), std::logic_error);
}

}  // namespace
}  // namespace lahar::cases
