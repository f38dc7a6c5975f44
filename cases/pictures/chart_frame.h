#pragma once
// The frame of a chart: where values lie on the canvas, and its axes.
#include "cases/pictures/axis.h"
#include "cases/pictures/canvas.h"
#include "cases/pictures/chart.h"
#include "cases/pictures/colour.h"
#include "cases/pictures/occupancy.h"

namespace lahar::cases {

inline const Colour kChartInk = from_hex(0x222222);
inline const Lettering kChartLettering{.colour = kChartInk, .size = 10};

struct ChartFrame {
  PlaneBox box;
  AxisTicks x, y;

  [[nodiscard]] Point at(double x_value, double y_value) const;
  [[nodiscard]] bool shows(double x_value, double y_value) const;  ///< finite, and within both axes
};

/// The frame of a chart with its axes and titles outside, and `above` points left free between title and frame.
[[nodiscard]] ChartFrame frame_of(const Chart& chart, Canvas& canvas, float above);

/// Thin lines at the major ticks.
void draw_grid(Canvas& canvas, const ChartFrame& frame);
/// Box, ticks, numbers and titles.
void draw_axes(Canvas& canvas, const Chart& chart, const ChartFrame& frame);

}  // namespace lahar::cases
