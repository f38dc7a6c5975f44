#pragma once
// Line charts as pictures, for time series.
#include <span>
#include <string>
#include <vector>

#include "cases/pictures/image.h"

namespace lahar::cases {

/// One line of a chart. Values that are not finite leave a gap.
struct ChartLine {
  std::string name;  ///< in the legend; may be empty
  std::vector<double> x, y;
  bool dashed = false;
};

struct ChartStyle {
  std::string title{}, x_label{}, y_label{};
  int width = 960, height = 540;  ///< pixels
};

/// Draws lines with axes, round ticks and a legend. Throws std::logic_error if a line's x and y differ in number or the
/// size is below 200 x 150 pixels.
[[nodiscard]] Image draw_chart(std::span<const ChartLine> lines, const ChartStyle& style);

/// Round numbers (steps of 1, 2 or 5 times a power of ten) that cover [low, high] with about `count` steps; the first
/// is <= low, the last >= high.
[[nodiscard]] std::vector<double> chart_ticks(double low, double high, int count);

}  // namespace lahar::cases
