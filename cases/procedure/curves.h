#pragma once
// Curves that are functions of something else than time, for charts and as a file.
#include <filesystem>
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

/// A copy with x and y multiplied.
[[nodiscard]] ChartSeries scaled_line(const std::string& name, const std::vector<double>& x,
                                      const std::vector<double>& y, double x_scale, double y_scale);

}  // namespace lahar::cases
