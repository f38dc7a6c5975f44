#include "cases/pictures/chart_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lahar::cases {

namespace {

const Pen kGridPen{.colour = from_hex(0xe2e5e8), .width = 0.5F};
const Pen kFramePen{.colour = kChartInk, .width = 0.7F};
const Lettering kTitle{.colour = kChartInk, .size = 11, .bold = true};
constexpr float kLine = 13;  // height of a line of letters
constexpr float kMajor = 4, kMinor = 2, kRim = 8;

DataRange range_of_x(const Chart& chart) {
  DataRange range(chart.x.scale);
  for (const ChartSeries& s : chart.series)
    for (const double v : s.x) range.include(v);
  for (const ChartGuide& g : chart.x_guides) range.include(g.at);
  return range;
}

DataRange range_of_y(const Chart& chart) {
  DataRange range(chart.y.scale);
  for (const ChartSeries& s : chart.series) {
    for (const double v : s.y) range.include(v);
    for (const double v : s.upper) range.include(v);
    for (std::size_t n = 0; n < s.error.size(); ++n)
      range.include(s.y[n] - s.error[n]), range.include(s.y[n] + s.error[n]);
  }
  for (const ChartGuide& g : chart.y_guides) range.include(g.at);
  return range;
}

float widest_label(Canvas& canvas, const AxisTicks& ticks) {
  float widest = 0;
  for (const std::string& label : ticks.labels) widest = std::max(widest, canvas.text_width(label, kChartLettering));
  return widest;
}

// Ticks point inwards, from both sides.
void draw_ticks(Canvas& canvas, const ChartFrame& frame, const std::vector<double>& values, bool along_x,
                float length) {
  const AxisTicks& ticks = along_x ? frame.x : frame.y;
  for (const double v : values) {
    const auto share = static_cast<float>(ticks.share(v));
    if (share < 1e-4F || share > 1 - 1e-4F) continue;
    const Point inward = along_x ? Point(0, length) : Point(length, 0);
    const Point from = along_x ? Point(frame.at(v, frame.y.low).x(), frame.box.min().y())
                               : Point(frame.box.min().x(), frame.at(frame.x.low, v).y());
    const Point across = along_x ? Point(0, frame.box.sizes().y()) : Point(frame.box.sizes().x(), 0);
    canvas.line(from, from + inward, kFramePen);
    canvas.line(from + across, from + across - inward, kFramePen);
  }
}

}  // namespace

Point ChartFrame::at(double x_value, double y_value) const {
  const Eigen::Vector2d share(x.share(x_value), 1 - y.share(y_value));
  return box.min() + share.cast<float>().cwiseProduct(box.sizes());
}

bool ChartFrame::shows(double x_value, double y_value) const {
  const double u = x.share(x_value), v = y.share(y_value);
  return u >= -1e-9 && u <= 1 + 1e-9 && v >= -1e-9 && v <= 1 + 1e-9;
}

ChartFrame frame_of(const Chart& chart, Canvas& canvas, float above) {
  ChartFrame frame;
  frame.x = ticks_of(chart.x, range_of_x(chart), std::max(2, static_cast<int>(chart.width / 65)));
  frame.y = ticks_of(chart.y, range_of_y(chart), std::max(2, static_cast<int>(chart.height / 42)));
  const float last_label =
      frame.x.labels.empty() ? 0 : 0.5F * canvas.text_width(frame.x.labels.back(), kChartLettering);
  const float title = chart.title.empty() ? 0 : kLine + 5, y_title = chart.y.label.empty() ? 0 : kLine + 4;
  const float x_title = chart.x.label.empty() ? 0 : kLine + 3;
  frame.box.min() = Point(kRim + y_title + widest_label(canvas, frame.y) + 5, kRim + title + above);
  frame.box.max() = Point(chart.width - kRim - std::max(4.0F, last_label), chart.height - kRim - x_title - kLine);
  return frame;
}

void draw_grid(Canvas& canvas, const ChartFrame& frame) {
  for (const double v : frame.x.major) canvas.line(frame.at(v, frame.y.low), frame.at(v, frame.y.high), kGridPen);
  for (const double v : frame.y.major) canvas.line(frame.at(frame.x.low, v), frame.at(frame.x.high, v), kGridPen);
}

void draw_axes(Canvas& canvas, const Chart& chart, const ChartFrame& frame) {
  const Point low = frame.box.min(), high = frame.box.max();
  const std::array<Point, 5> corners{low, Point(high.x(), low.y()), high, Point(low.x(), high.y()), low};
  canvas.line(corners, kFramePen);
  draw_ticks(canvas, frame, frame.x.major, true, kMajor);
  draw_ticks(canvas, frame, frame.x.minor, true, kMinor);
  draw_ticks(canvas, frame, frame.y.major, false, kMajor);
  draw_ticks(canvas, frame, frame.y.minor, false, kMinor);
  for (std::size_t n = 0; n < frame.x.major.size(); ++n)
    canvas.text(Point(frame.at(frame.x.major[n], frame.y.low).x(), high.y() + kLine), frame.x.labels[n],
                kChartLettering, Hold::middle);
  for (std::size_t n = 0; n < frame.y.major.size(); ++n)
    canvas.text(frame.at(frame.x.low, frame.y.major[n]) + Point(-5, 0.5F * kCapHeight * kChartLettering.size),
                frame.y.labels[n], kChartLettering, Hold::end);
  const Point middle = 0.5F * (low + high);
  canvas.text(Point(middle.x(), chart.height - kRim - 1), axis_title(chart.x, frame.x), kChartLettering, Hold::middle);
  canvas.text(Point(kRim + kCapHeight * kChartLettering.size, middle.y()), axis_title(chart.y, frame.y),
              kChartLettering, Hold::middle, 90);
  canvas.text(Point(low.x(), kRim + kCapHeight * kTitle.size), chart.title, kTitle);
}

}  // namespace lahar::cases
