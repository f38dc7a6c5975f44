#include "cases/files/series_writer.h"

#include <algorithm>
#include <limits>

#include "core/check.h"

namespace lahar::cases {

namespace {

constexpr std::uint64_t kChunkRows = 512;
const std::string kGroup = "/series";
const std::string kTime = "/series/time_s";

bool usable_name(const std::string& name) {
  return !name.empty() && name != "time_s" && name != "." && name.find('/') == std::string::npos;
}

}  // namespace

SeriesWriter::SeriesWriter(std::filesystem::path path, Hdf5File file, std::size_t rows_per_write)
    : grown_(std::move(path)),
      file_(std::move(file)),
      rows_per_write_(std::max<std::size_t>(1, rows_per_write)),
      last_time_s_(-std::numeric_limits<double>::infinity()) {}

SeriesWriter::SeriesWriter(const std::filesystem::path& path, std::size_t rows_per_write)
    : SeriesWriter(path, Hdf5File::create(GrowingFile(path).open_name()), rows_per_write) {
  time_.push_back({file_.create_column(kTime, kChunkRows), "s", {}});
  file_.set_attribute(kTime, "unit", std::string("s"));
  file_.set_attribute(kTime, "description", std::string("simulated time"));
}

SeriesWriter SeriesWriter::resume(const std::filesystem::path& path, double until_s, std::size_t rows_per_write) {
  const GrowingFile grown(path);
  grown.take_up();
  SeriesWriter writer(path, Hdf5File::open_for_appending(grown.open_name()), rows_per_write);
  const std::vector<double> times = writer.file_.read<double>(kTime);
  const auto kept = std::upper_bound(times.begin(), times.end(), until_s) - times.begin();
  writer.rows_ = static_cast<std::size_t>(kept);
  if (kept > 0) writer.last_time_s_ = times[writer.rows_ - 1];
  for (const std::string& name : writer.file_.columns(kGroup, {"unit", "description"})) {
    const std::string column = kGroup + "/" + name;
    if (column == kTime) continue;
    try {
      (void)writer.file_.read<double>(column);
      writer.file_.open_column(column).truncate(writer.rows_);
    } catch (const FileError&) {
      writer.file_.remove(column);
      writer.lost_.push_back(name);
    }
  }
  Hdf5Column time = writer.file_.open_column(kTime);
  time.truncate(writer.rows_);
  writer.time_.push_back({std::move(time), "s", {}});
  return writer;
}

SeriesWriter::~SeriesWriter() {
  try {
    close();
  } catch (const std::exception&) {
    // Nobody left to tell: whoever wants to know calls close().
  }
}

std::size_t SeriesWriter::declare(const std::string& name, const std::string& unit, const std::string& description) {
  require(usable_name(name), "SeriesWriter::declare: the name is empty, reserved or holds a slash");
  require(!time_.empty(), "SeriesWriter::declare: the file is closed");
  const auto known = std::find(names_.begin(), names_.end(), name);
  const auto index = static_cast<std::size_t>(known - names_.begin());
  if (known != names_.end()) {
    require(columns_[index].unit == unit, "SeriesWriter::declare: the column was declared with another unit");
    return index;
  }
  const std::string path = kGroup + "/" + name;
  const bool earlier_run = file_.contains(path);
  Column column{earlier_run ? file_.open_column(path) : file_.create_column(path, kChunkRows), unit, {}};
  if (earlier_run) {
    require(file_.text_attribute(path, "unit") == unit, "SeriesWriter::declare: the earlier run used another unit");
  } else {
    file_.set_attribute(path, "unit", unit);
    file_.set_attribute(path, "description", description);
  }
  column.pending.assign(rows_ - column.data.rows(), std::numeric_limits<double>::quiet_NaN());
  columns_.push_back(std::move(column));
  names_.push_back(name);
  return index;
}

void SeriesWriter::append(double time_s, std::span<const double> values) {
  require(!time_.empty(), "SeriesWriter::append: the file is closed");
  require(values.size() == columns_.size(), "SeriesWriter::append: one value per declared column is needed");
  require(time_s >= last_time_s_, "SeriesWriter::append: time goes back");
  last_time_s_ = time_s;
  time_[0].pending.push_back(time_s);
  for (std::size_t c = 0; c < values.size(); ++c) columns_[c].pending.push_back(values[c]);
  ++rows_;
  if (time_[0].pending.size() >= rows_per_write_) write_rows();
  grown_.copy_if_due([this] { flush(); });
}

void SeriesWriter::write_pending(Column& column) {
  column.data.append(column.pending);
  column.pending.clear();
}

void SeriesWriter::write_rows() {
  whole_ = false;
  for (Column& column : columns_) write_pending(column);
  write_pending(time_[0]);
  whole_ = true;
}

/// To the system as well: as columns close nobody hears of what fails.
void SeriesWriter::write_all() {
  write_rows();
  whole_ = false;
  file_.flush();
  whole_ = true;
}

void SeriesWriter::flush() {
  if (time_.empty()) return;
  write_all();
  grown_.copy();
}

void SeriesWriter::close() {
  if (time_.empty()) return;
  const bool whole = whole_;
  if (whole) write_all();
  columns_.clear();
  time_.clear();
  if (!whole) return;
  file_.close();
  grown_.finish();
}

}  // namespace lahar::cases
