#pragma once
// Reads what SeriesWriter wrote.
#include <filesystem>
#include <string>
#include <vector>

namespace lahar::cases {

struct Series {
  struct Column {
    std::string name, unit, description;
    std::vector<double> values;
  };
  std::vector<double> time_s;
  std::vector<Column> columns;  ///< in alphabetical order

  /// The column of that name, nullptr if there is none.
  [[nodiscard]] const Column* find(const std::string& name) const;
};

/// Reads series.h5. Every column has as many values as there are times: a killed run may leave more, which are dropped,
/// and a column that was no longer written holds NaN at its end. What others have added is left out. Throws FileError.
[[nodiscard]] Series read_series(const std::filesystem::path& path);

}  // namespace lahar::cases
