#include "cases/files/series_reader.h"

#include <algorithm>
#include <limits>

#include "cases/files/hdf5_file.h"

namespace lahar::cases {

const Series::Column* Series::find(const std::string& name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Series read_series(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::open_for_reading(path);
  Series series;
  series.time_s = file.read<double>("/series/time_s");
  for (const std::string& name : file.columns("/series", {"unit", "description"})) {
    if (name == "time_s") continue;
    const std::string dataset = "/series/" + name;
    series.columns.push_back({name, file.text_attribute(dataset, "unit"), file.text_attribute(dataset, "description"),
                              file.read<double>(dataset)});
    series.columns.back().values.resize(series.time_s.size(), std::numeric_limits<double>::quiet_NaN());
  }
  return series;
}

}  // namespace lahar::cases
