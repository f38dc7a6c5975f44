#pragma once
// Curves that are functions of something else than time, as a picture and as a file.
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cases/pictures/chart.h"

namespace lahar::cases {

struct CurveColumn {
  std::string name, unit, description;
  std::vector<double> values;
};

/// series.h5 with these columns over the time of each row (s). All must be equally long.
void write_series(const std::filesystem::path& folder, const std::vector<double>& time,
                  const std::vector<CurveColumn>& columns);

/// Draws lines into a file of this name.
void write_chart(const std::filesystem::path& file, std::span<const ChartLine> lines, const ChartStyle& style);

/// A copy with x and y multiplied.
[[nodiscard]] ChartLine scaled_line(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
                                    double x_scale, double y_scale, bool dashed = false);

}  // namespace lahar::cases
