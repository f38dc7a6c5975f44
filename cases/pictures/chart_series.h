#pragma once
// How the series of a chart are drawn.
#include <span>

#include "cases/pictures/chart_frame.h"

namespace lahar::cases {

/// What distinguishes the series of a chart from each other.
struct SeriesLook {
  Pen pen;
  PointShape shape = PointShape::circle;
};
[[nodiscard]] std::vector<SeriesLook> looks_of(std::span<const ChartSeries> series);

/// Connected parts of a series on the canvas, without points that nobody would see.
[[nodiscard]] std::vector<std::vector<Point>> curves_of(const ChartSeries& series, const ChartFrame& frame);

/// Keeps of successive points in the same narrow column the first, the highest, the lowest and the last.
[[nodiscard]] std::vector<Point> thinned(std::span<const Point> points, float column_width);

void draw_series(Canvas& canvas, const ChartSeries& series, const SeriesLook& look, const ChartFrame& frame);

/// A short piece of a series for the legend, from `left` to the right.
void draw_sample(Canvas& canvas, const ChartSeries& series, const SeriesLook& look, const Point& left, float length);

/// Adds what a series covers.
void occupy(Occupancy& taken, const ChartSeries& series, const ChartFrame& frame);

}  // namespace lahar::cases
