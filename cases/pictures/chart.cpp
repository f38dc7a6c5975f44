#include "cases/pictures/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cases/pictures/drawing.h"
#include "core/check.h"

namespace lahar::cases {

namespace {

const Colour kInk = from_hex(0x2a3138), kAxis = from_hex(0x8b949c), kGrid = from_hex(0xe3e6e9);
// Distinguishable with the common forms of colour blindness (blue, vermilion, green, purple, amber, sky).
constexpr std::array<std::uint32_t, 6> kLineColours{0x1f5fa8, 0xd1491b, 0x1d8a68, 0x8e4a9e, 0xd99a17, 0x4fa6d8};
constexpr float kLetters = 10;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void include(std::span<const double> values) {
    for (const double v : values)
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  }
  // Never empty: a constant gets some room around it.
  [[nodiscard]] Range usable() const {
    if (low > high) return {0, 1};
    const double room = low == high ? std::max(0.5 * std::abs(low), 0.5) : 0;
    return {low - room, high + room};
  }
};

struct Axis {
  std::vector<double> ticks;
  float first = 0, last = 0;  // pixels of the first and last tick
  [[nodiscard]] float pixel(double v) const {
    const double t = (v - ticks.front()) / (ticks.back() - ticks.front());
    return first + static_cast<float>(t) * (last - first);
  }
};

std::string tick_label(double value, double step) {
  if (std::abs(value) < 1e-9 * step) return "0";
  if (std::abs(value) >= 1e5 || step < 1e-4) return fmt::format("{:.4g}", value);
  return fmt::format("{:.{}f}", value, std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9))));
}

double step_of(const Axis& axis) { return axis.ticks[1] - axis.ticks[0]; }

void draw_x_axis(Image& image, const Axis& x, const Axis& y) {
  for (const double tick : x.ticks) {
    const float at = x.pixel(tick);
    draw_line(image, Point(at, y.first), Point(at, y.last), {kGrid, 1});
    draw_line(image, Point(at, y.first), Point(at, y.first + 5), {kAxis, 1});
    const std::string label = tick_label(tick, step_of(x));
    draw_text(image, Point(at - 0.5F * text_width(label, kLetters), y.first + 10 + kLetters), label, {kInk, kLetters});
  }
}

void draw_y_axis(Image& image, const Axis& x, const Axis& y) {
  for (const double tick : y.ticks) {
    const float at = y.pixel(tick);
    draw_line(image, Point(x.first, at), Point(x.last, at), {kGrid, 1});
    draw_line(image, Point(x.first - 5, at), Point(x.first, at), {kAxis, 1});
    const std::string label = tick_label(tick, step_of(y));
    draw_text(image, Point(x.first - 10 - text_width(label, kLetters), at + 0.5F * kLetters), label, {kInk, kLetters});
  }
}

Pen pen_of(std::size_t line) { return {from_hex(kLineColours[line % kLineColours.size()]), 2}; }

// The part of a segment inside the frame is all of it: the axes cover every value. Dashes are 8 pixels long, 5 apart.
void draw_run(Image& image, std::span<const Point> run, const Pen& pen, bool dashed) {
  if (!dashed) return draw_line(image, run, pen);
  constexpr float dash = 8, period = 13;
  float walked = 0;
  for (std::size_t i = 0; i + 1 < run.size(); ++i) {
    const Point along = run[i + 1] - run[i];
    const float length = along.norm();
    for (float start = -std::fmod(walked, period); start < length; start += period) {
      const float from = std::max(start, 0.0F), to = std::min(start + dash, length);
      if (to > from) draw_line(image, run[i] + along * (from / length), run[i] + along * (to / length), pen);
    }
    walked += length;
  }
}

void draw_data(Image& image, const ChartLine& line, const Axis& x, const Axis& y, const Pen& pen) {
  std::vector<Point> run;
  for (std::size_t n = 0; n < line.x.size(); ++n) {
    if (std::isfinite(line.x[n]) && std::isfinite(line.y[n])) {
      run.emplace_back(x.pixel(line.x[n]), y.pixel(line.y[n]));
      continue;
    }
    if (!run.empty()) draw_run(image, run, pen, line.dashed);
    run.clear();
  }
  if (!run.empty()) draw_run(image, run, pen, line.dashed);
}

// One row above the frame, from the left.
void draw_legend(Image& image, std::span<const ChartLine> lines, Point cursor) {
  for (std::size_t n = 0; n < lines.size(); ++n) {
    if (lines[n].name.empty()) continue;
    const std::array<Point, 2> sample{cursor - Point(0, 0.5F * kLetters), cursor + Point(26, -0.5F * kLetters)};
    draw_run(image, sample, pen_of(n), lines[n].dashed);
    draw_text(image, cursor + Point(33, 0), lines[n].name, {kInk, kLetters});
    cursor.x() += 33 + text_width(lines[n].name, kLetters) + 24;
  }
}

}  // namespace

std::vector<double> chart_ticks(double low, double high, int count) {
  require(std::isfinite(low) && std::isfinite(high) && low < high && count > 0, "chart_ticks: empty range");
  const double rough = (high - low) / count, power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (rough <= factor * power * (1 + 1e-9)) step = factor * power;
  std::vector<double> ticks;
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  for (double n = first; n <= last; ++n) ticks.push_back(n * step);
  return ticks;
}

Image draw_chart(std::span<const ChartLine> lines, const ChartStyle& style) {
  require(style.width >= 200 && style.height >= 150, "draw_chart: the picture is too small");
  Range x_range, y_range;
  for (const ChartLine& line : lines) {
    require(line.x.size() == line.y.size(), "draw_chart: x and y differ in number");
    x_range.include(line.x);
    y_range.include(line.y);
  }
  x_range = x_range.usable(), y_range = y_range.usable();
  const auto width = static_cast<float>(style.width), height = static_cast<float>(style.height);
  Axis y{chart_ticks(y_range.low, y_range.high, std::max(2, style.height / 90)), height - 62, 84};
  float label_width = 0;
  for (const double tick : y.ticks)
    label_width = std::max(label_width, text_width(tick_label(tick, step_of(y)), kLetters));
  const Axis x{chart_ticks(x_range.low, x_range.high, std::max(2, style.width / 120)), 34 + label_width, width - 34};
  Image image(style.width, style.height);
  draw_x_axis(image, x, y);
  draw_y_axis(image, x, y);
  const std::array<Point, 3> frame{Point(x.first, y.last), Point(x.first, y.first), Point(x.last, y.first)};
  draw_line(image, frame, {kAxis, 1.4F});
  for (std::size_t n = 0; n < lines.size(); ++n) draw_data(image, lines[n], x, y, pen_of(n));
  draw_text(image, Point(24, 36), style.title, {kInk, 14});
  draw_text(image, Point(24, 70), style.y_label, {kInk, kLetters});
  draw_text(image, Point(x.last - text_width(style.x_label, kLetters), height - 16), style.x_label, {kInk, kLetters});
  draw_legend(image, lines, Point(48 + text_width(style.y_label, kLetters), 70));
  return image;
}

}  // namespace lahar::cases
