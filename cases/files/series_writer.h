#pragma once
// series.h5: time series. Each column is a one-dimensional dataset /series/NAME of doubles with the attributes `unit`
// and `description`; /series/time_s is the common abscissa. What is no such column was added by others and stays.
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cases/files/growing_file.h"
#include "cases/files/hdf5_file.h"

namespace lahar::cases {

/// Writes series.h5 row by row. Whatever happens the file is whole: a killed run loses at most the rows of its last
/// second, or of 50 times as long as a copy takes, and those that were not yet gathered. Every function throws
/// FileError when the file cannot be written, after which others go on seeing the last whole one.
class SeriesWriter {
 public:
  /// Starts a new file. `rows_per_write` rows are gathered before they are written.
  explicit SeriesWriter(const std::filesystem::path& path, std::size_t rows_per_write = 64);
  /// Goes on with the file of an earlier run; rows later than `until_s` are dropped, and columns that cannot be read,
  /// see lost().
  static SeriesWriter resume(const std::filesystem::path& path, double until_s, std::size_t rows_per_write = 64);
  SeriesWriter(SeriesWriter&&) = default;
  SeriesWriter& operator=(SeriesWriter&&) = delete;
  ~SeriesWriter();

  /// Announces a column and returns its index. Asking again for a known name returns the same index. A column that is
  /// declared after rows were appended holds NaN in them. Throws std::logic_error for an unusable name or if the unit
  /// differs from that of the first declaration, FileError if something of that name is there that is no column.
  std::size_t declare(const std::string& name, const std::string& unit, const std::string& description);

  /// One row: a value for each declared column, in the order of declaration. Times must not go back. Throws
  /// std::logic_error if the number of values or the time is wrong.
  void append(double time_s, std::span<const double> values);
  void append(double time_s, std::initializer_list<double> values) {
    append(time_s, std::span<const double>(values.begin(), values.size()));
  }

  /// Puts all rows into the file. Throws CannotCopy if they are only in what grows (growing_file.h).
  void flush();
  /// The same, and closes; nothing may be appended afterwards.
  void close();

  [[nodiscard]] std::size_t columns() const { return columns_.size(); }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  /// Why append could not bring up to date what others see; empty if it could.
  [[nodiscard]] const std::string& refusal() const { return grown_.refusal(); }
  /// Columns of the earlier run that could not be read.
  [[nodiscard]] const std::vector<std::string>& lost() const { return lost_; }

 private:
  struct Column {
    Hdf5Column data;
    std::string unit;
    std::vector<double> pending;
  };
  SeriesWriter(std::filesystem::path path, Hdf5File file, std::size_t rows_per_write);
  static void write_pending(Column& column);
  void write_rows();
  void write_all();

  GrowingFile grown_;
  Hdf5File file_;
  std::size_t rows_per_write_, rows_ = 0;
  bool whole_ = true;  // no write has failed: after one HDF5 may have lost rows that it was given before
  std::vector<std::string> lost_;
  double last_time_s_;
  std::vector<Column> time_;  // one element, none once closed
  std::vector<Column> columns_;
  std::vector<std::string> names_;
};

}  // namespace lahar::cases
