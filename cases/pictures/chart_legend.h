#pragma once
// The legend of a chart and the names of its guides, where they cover no curve.
#include "cases/pictures/chart_series.h"

namespace lahar::cases {

struct ChartLegend {
  std::vector<std::size_t> entries;  ///< series with a name
  std::vector<Point> places;         ///< of the left end of each sample, on the middle of its line
  std::optional<PlaneBox> ground;    ///< inside the frame; nothing where it stands above
  float above = 0;                   ///< height that it takes above the frame
};

/// Inside the frame if there is a place free of `taken`, else in rows above the frame, which `above` makes room for.
[[nodiscard]] ChartLegend legend_of(const Chart& chart, Canvas& canvas, const ChartFrame& frame,
                                    const Occupancy& taken);

void draw_legend(Canvas& canvas, const Chart& chart, const ChartLegend& legend);

/// Draws the guides, each with its name where nothing is taken.
void draw_guides(Canvas& canvas, const Chart& chart, const ChartFrame& frame, const Occupancy& taken);

}  // namespace lahar::cases
