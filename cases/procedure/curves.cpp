#include "cases/procedure/curves.h"

#include "cases/files/series_writer.h"
#include "core/check.h"

namespace lahar::cases {

void write_series(const std::filesystem::path& folder, const std::vector<double>& time,
                  const std::vector<CurveColumn>& columns) {
  SeriesWriter series(folder / "series.h5");
  for (const CurveColumn& c : columns) {
    require(c.values.size() == time.size(), "a column of a series needs a value for each time");
    series.declare(c.name, c.unit, c.description);
  }
  std::vector<double> row(columns.size());
  for (std::size_t k = 0; k < time.size(); ++k) {
    for (std::size_t c = 0; c < columns.size(); ++c) row[c] = columns[c].values[k];
    series.append(time[k], row);
  }
  series.close();
}

ChartSeries scaled_line(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
                        double x_scale, double y_scale) {
  ChartSeries line{.name = name, .x = x, .y = y};
  for (double& v : line.x) v *= x_scale;
  for (double& v : line.y) v *= y_scale;
  return line;
}

}  // namespace lahar::cases
