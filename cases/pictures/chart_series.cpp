#include "cases/pictures/chart_series.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lahar::cases {

namespace {

constexpr std::array<std::uint32_t, 7> kColours{0x1f5fa8, 0xd1491b, 0x1d8a68, 0x8e4a9e, 0xd99a17, 0x4fa6d8, 0x222222};
constexpr int kShapes = 5;
constexpr float kLineWidth = 1.3F, kThinLine = 0.9F, kRadius = 2.8F, kCap = 2;
constexpr float kBandOpacity = 0.22F;
constexpr float kColumn = 0.15F;  // points: half a pixel of the picture

std::vector<double> dashes_of(Dash dash) {
  if (dash == Dash::dashed) return {5, 2.6};
  if (dash == Dash::dotted) return {1.4, 1.9};
  if (dash == Dash::dash_dot) return {6, 2.2, 1.4, 2.2};
  return {};
}

bool has_line(const ChartSeries& s) { return s.mark == Mark::line || s.mark == Mark::line_and_points; }
bool has_points(const ChartSeries& s) { return s.mark == Mark::points || s.mark == Mark::line_and_points; }

// Corners relative to the middle; all shapes cover about the same area.
std::vector<Point> corners_of(PointShape shape) {
  const float s = 0.89F * kRadius, t = 1.35F * kRadius, d = 1.25F * kRadius;
  if (shape == PointShape::square) return {{-s, -s}, {s, -s}, {s, s}, {-s, s}};
  if (shape == PointShape::diamond) return {{-d, 0}, {0, -d}, {d, 0}, {0, d}};
  const float up = shape == PointShape::triangle ? -1.0F : 1.0F;
  return {{0, up * t}, {0.87F * t, -0.5F * up * t}, {-0.87F * t, -0.5F * up * t}};
}

void draw_point(Canvas& canvas, const Point& at, const SeriesLook& look) {
  const Pen rim{.colour = look.pen.colour, .width = kThinLine};
  if (look.shape == PointShape::circle) return canvas.disc(at, kRadius, Colour::Ones(), rim);
  std::vector<Point> corners = corners_of(look.shape);
  for (Point& c : corners) c += at;
  canvas.area(corners, Colour::Ones(), 1, rim);
}

void draw_error_bar(Canvas& canvas, const Point& low, const Point& high, const Colour& colour) {
  const Pen pen{.colour = colour, .width = kThinLine};
  canvas.line(low, high, pen);
  for (const Point& end : {low, high}) canvas.line(end - Point(kCap, 0), end + Point(kCap, 0), pen);
}

// Values below what a logarithmic axis shows end at its lower end.
Point end_of_bar(const ChartFrame& frame, double x, double y) {
  return frame.at(x, std::clamp(y, frame.y.low, frame.y.high));
}

void draw_error_bars(Canvas& canvas, const ChartSeries& s, const SeriesLook& look, const ChartFrame& frame) {
  for (std::size_t n = 0; n < s.error.size(); ++n)
    if (frame.shows(s.x[n], s.y[n]) && std::isfinite(s.error[n]))
      draw_error_bar(canvas, end_of_bar(frame, s.x[n], s.y[n] - s.error[n]),
                     end_of_bar(frame, s.x[n], s.y[n] + s.error[n]), look.pen.colour);
}

void draw_band(Canvas& canvas, const ChartSeries& s, const SeriesLook& look, const ChartFrame& frame) {
  ChartSeries upper = s;
  upper.y = s.upper;
  const auto below = curves_of(s, frame), above = curves_of(upper, frame);
  for (std::size_t k = 0; k < std::min(below.size(), above.size()); ++k) {
    std::vector<Point> corners = below[k];
    corners.insert(corners.end(), above[k].rbegin(), above[k].rend());
    canvas.area(corners, look.pen.colour, kBandOpacity);
  }
}

}  // namespace

std::vector<SeriesLook> looks_of(std::span<const ChartSeries> series) {
  std::vector<SeriesLook> looks;
  int next = 0;
  for (std::size_t n = 0; n < series.size(); ++n) {
    const ChartSeries& s = series[n];
    const std::size_t colour = s.colour ? static_cast<std::size_t>(*s.colour) : n % (kColours.size() - 1);
    looks.push_back({{.colour = from_hex(kColours[colour]), .width = kLineWidth, .dashes = dashes_of(s.dash)},
                     s.shape.value_or(static_cast<PointShape>(next))});
    if (has_points(s)) next = (next + 1) % kShapes;
  }
  return looks;
}

std::vector<Point> thinned(std::span<const Point> points, float column_width) {
  std::vector<Point> kept;
  const auto column = [&](std::size_t i) { return std::floor(points[i].x() / column_width); };
  for (std::size_t first = 0, end = 0; first < points.size(); first = end) {
    while (end < points.size() && column(end) == column(first)) ++end;
    std::size_t low = first, high = first;
    for (std::size_t i = first; i < end; ++i) {
      if (points[i].y() < points[low].y()) low = i;
      if (points[i].y() > points[high].y()) high = i;
    }
    std::array<std::size_t, 4> chosen{first, std::min(low, high), std::max(low, high), end - 1};
    const auto* last = std::unique(chosen.begin(), chosen.end());
    for (const auto* i = chosen.begin(); i != last; ++i) kept.push_back(points[*i]);
  }
  return kept;
}

std::vector<std::vector<Point>> curves_of(const ChartSeries& series, const ChartFrame& frame) {
  const DataRange x(frame.x.scale), y(frame.y.scale);
  std::vector<std::vector<Point>> curves;
  std::vector<Point> run;
  const auto end_run = [&] {
    if (!run.empty()) curves.push_back(thinned(run, kColumn));
    run.clear();
  };
  for (std::size_t n = 0; n < series.x.size(); ++n) {
    if (x.shows(series.x[n]) && y.shows(series.y[n]))
      run.push_back(frame.at(series.x[n], series.y[n]));
    else
      end_run();
  }
  end_run();
  return curves;
}

void draw_series(Canvas& canvas, const ChartSeries& series, const SeriesLook& look, const ChartFrame& frame) {
  const Point rim = Point::Constant(kLineWidth / 2);
  canvas.clip(frame.box.min() - rim, frame.box.max() + rim);
  if (series.mark == Mark::band) draw_band(canvas, series, look, frame);
  if (has_line(series))
    for (const auto& curve : curves_of(series, frame)) canvas.line(curve, look.pen);
  canvas.unclip();
  draw_error_bars(canvas, series, look, frame);
  if (!has_points(series)) return;
  for (std::size_t n = 0; n < series.x.size(); ++n)
    if (frame.shows(series.x[n], series.y[n])) draw_point(canvas, frame.at(series.x[n], series.y[n]), look);
}

void draw_sample(Canvas& canvas, const ChartSeries& series, const SeriesLook& look, const Point& left, float length) {
  const Point right = left + Point(length, 0), middle = 0.5F * (left + right);
  if (series.mark == Mark::band)
    return canvas.rectangle(left - Point(0, 3.5F), right + Point(0, 3.5F), look.pen.colour, kBandOpacity);
  if (has_line(series)) canvas.line(left, right, look.pen);
  if (!series.error.empty())
    draw_error_bar(canvas, middle + Point(0, 1.7F * kRadius), middle - Point(0, 1.7F * kRadius), look.pen.colour);
  if (has_points(series)) draw_point(canvas, middle, look);
}

void occupy(Occupancy& taken, const ChartSeries& series, const ChartFrame& frame) {
  const Point reach = Point::Constant(kRadius + 1);
  if (series.mark != Mark::points)
    for (const auto& curve : curves_of(series, frame)) taken.add_line(curve);
  if (series.mark == Mark::points)
    for (std::size_t n = 0; n < series.x.size(); ++n)
      if (frame.shows(series.x[n], series.y[n])) {
        const Point p = frame.at(series.x[n], series.y[n]);
        taken.add_box({p - reach, p + reach});
      }
  for (std::size_t n = 0; n < series.error.size(); ++n)
    if (frame.shows(series.x[n], series.y[n]))
      taken.add_box({end_of_bar(frame, series.x[n], series.y[n] + series.error[n]),
                     end_of_bar(frame, series.x[n], series.y[n] - series.error[n])});
  for (std::size_t n = 0; n < series.upper.size(); ++n)
    if (frame.shows(series.x[n], series.y[n]))
      taken.add_box({end_of_bar(frame, series.x[n], series.upper[n]), end_of_bar(frame, series.x[n], series.y[n])});
}

}  // namespace lahar::cases
