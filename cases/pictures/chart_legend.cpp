#include "cases/pictures/chart_legend.h"

#include <algorithm>
#include <array>

namespace lahar::cases {

namespace {

constexpr float kSample = 22, kGap = 5, kRow = 14, kPadding = 5, kBetween = 16, kOff = 6;
const Lettering kSmall{.colour = from_hex(0x555555), .size = 9};
const Pen kGuidePen{.colour = from_hex(0x777777), .width = 0.9F, .dashes = {4, 2.5}};

float entry_width(Canvas& canvas, const ChartSeries& series) {
  return kSample + kGap + canvas.text_width(series.name, kChartLettering);
}

// Upper left corners of a box of this size along the rim of the frame: corners first.
std::vector<Point> places_inside(const PlaneBox& frame, const Point& size) {
  const Point low = frame.min() + Point::Constant(kOff), high = frame.max() - size - Point::Constant(kOff);
  const Point mid = 0.5F * (low + high);
  return {{high.x(), low.y()}, {low.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}, {high.x(), mid.y()},
          {low.x(), mid.y()},  {mid.x(), low.y()}, {mid.x(), high.y()},  {mid.x(), mid.y()}};
}

ChartLegend listed_at(std::vector<std::size_t> entries, const PlaneBox& ground) {
  ChartLegend legend{std::move(entries), {}, ground, 0};
  for (std::size_t n = 0; n < legend.entries.size(); ++n)
    legend.places.push_back(ground.min() + Point(kPadding, kPadding + kRow * (static_cast<float>(n) + 0.5F)));
  return legend;
}

// Rows from the left, broken where the frame ends.
ChartLegend rows_above(const Chart& chart, Canvas& canvas, const ChartFrame& frame, std::vector<std::size_t> entries) {
  ChartLegend legend{std::move(entries), {}, std::nullopt, kRow};
  Point cursor(frame.box.min().x(), 0);
  for (const std::size_t n : legend.entries) {
    const float width = entry_width(canvas, chart.series[n]);
    if (cursor.x() > frame.box.min().x() && cursor.x() + width > frame.box.max().x())
      cursor = Point(frame.box.min().x(), cursor.y() + kRow), legend.above += kRow;
    legend.places.push_back(cursor);
    cursor.x() += width + kBetween;
  }
  legend.above += 4;
  for (Point& p : legend.places) p.y() += frame.box.min().y() + 0.5F * kRow;
  return legend;
}

struct GuideName {
  Point at;
  float degrees;
  PlaneBox box;
};

// Along the upper or right end of the line first, on either side.
std::vector<GuideName> places_along(const PlaneBox& frame, const Point& on_line, float width, bool upright) {
  constexpr float off = 4, letters = 7;
  std::vector<GuideName> places;
  for (const float share : {0.0F, 1.0F, 0.5F})
    for (const bool second_side : {false, true}) {
      if (upright) {
        const float top = frame.min().y() + kOff + share * (frame.sizes().y() - 2 * kOff - width);
        const float base = on_line.x() + (second_side ? off + letters : -off);
        places.push_back(
            {Point(base, top + width), 90, PlaneBox(Point(base - letters - 1, top), Point(base + 1, top + width))});
      } else {
        const float left = frame.max().x() - kOff - width - share * (frame.sizes().x() - 2 * kOff - width);
        const float base = on_line.y() + (second_side ? off + letters : -off);
        places.push_back(
            {Point(left, base), 0, PlaneBox(Point(left, base - letters - 1), Point(left + width, base + 1))});
      }
    }
  return places;
}

void draw_guide(Canvas& canvas, const ChartGuide& guide, const ChartFrame& frame, bool upright, Occupancy& taken) {
  const Point from = upright ? frame.at(guide.at, frame.y.low) : frame.at(frame.x.low, guide.at);
  const Point to = upright ? frame.at(guide.at, frame.y.high) : frame.at(frame.x.high, guide.at);
  canvas.line(from, to, kGuidePen);
  if (guide.name.empty()) return;
  const auto places = places_along(frame.box, from, canvas.text_width(guide.name, kSmall), upright);
  const auto free = std::find_if(places.begin(), places.end(), [&](const GuideName& place) {
    return frame.box.contains(place.box) && taken.is_free(place.box);
  });
  const GuideName& chosen = free == places.end() ? places.front() : *free;
  canvas.text(chosen.at, guide.name, kSmall, Hold::start, chosen.degrees);
  taken.add_box(chosen.box);
}

}  // namespace

ChartLegend legend_of(const Chart& chart, Canvas& canvas, const ChartFrame& frame, const Occupancy& taken) {
  std::vector<std::size_t> entries;
  float width = 0;
  for (std::size_t n = 0; n < chart.series.size(); ++n) {
    if (chart.series[n].name.empty()) continue;
    entries.push_back(n);
    width = std::max(width, entry_width(canvas, chart.series[n]));
  }
  if (entries.empty()) return {};
  const Point size(width + 2 * kPadding, kRow * static_cast<float>(entries.size()) + 2 * kPadding);
  for (const Point& corner : places_inside(frame.box, size)) {
    const PlaneBox ground(corner, corner + size);
    if (frame.box.contains(ground) && taken.is_free(ground)) return listed_at(std::move(entries), ground);
  }
  return rows_above(chart, canvas, frame, std::move(entries));
}

void draw_legend(Canvas& canvas, const Chart& chart, const ChartLegend& legend) {
  if (legend.ground) canvas.rectangle(legend.ground->min(), legend.ground->max(), Colour::Ones(), 0.85F);
  const auto looks = looks_of(chart.series);
  for (std::size_t k = 0; k < legend.entries.size(); ++k) {
    const std::size_t n = legend.entries[k];
    draw_sample(canvas, chart.series[n], looks[n], legend.places[k], kSample);
    canvas.text(legend.places[k] + Point(kSample + kGap, 0.5F * kCapHeight * kChartLettering.size),
                chart.series[n].name, kChartLettering);
  }
}

void draw_guides(Canvas& canvas, const Chart& chart, const ChartFrame& frame, const Occupancy& taken) {
  Occupancy left = taken;
  for (const ChartGuide& guide : chart.x_guides) draw_guide(canvas, guide, frame, true, left);
  for (const ChartGuide& guide : chart.y_guides) draw_guide(canvas, guide, frame, false, left);
}

}  // namespace lahar::cases
