#pragma once
// A quantity of a run: name, unit, meaning, how it is read, and what is made of it: a column of series.h5, metrics of
// summary.json, or both. The tables of docs/outputs.md are made from the same objects.
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lahar::cases {

/// Metrics of summary.json by name.
using Metrics = std::map<std::string, double>;

/// A name in files, and how docs write it: PROBE, SECTION, PART and AXIS stand for what differs from scene to scene.
struct Label {
  Label(const char* plain) : name(plain), pattern(plain) {}
  Label(std::string in_files, std::string in_docs) : name(std::move(in_files)), pattern(std::move(in_docs)) {}
  std::string name, pattern;
};

/// How a metric follows from what its quantity reads.
enum class Follow {
  last,            ///< the value at the end
  first,           ///< the first row whose value is not NaN; absent without one
  peak,            ///< the largest of the rows
  peak_magnitude,  ///< the same of absolute values
  peak_time,       ///< s, the row of the peak that stands before this metric; none without one
};

struct Metric {
  Label label;
  std::string unit, meaning;
  Follow follow = Follow::last;
  double divisor = 1;  ///< a number of the quantity over that of the metric: 1000 of N for kN
};

struct Quantity {
  Label label;
  std::string unit, meaning;
  std::function<double()> read;  ///< of the state of the run, or of the last look of its observer
  bool is_column = false;
  std::vector<Metric> metrics;
  /// NaN says that there is nothing to say: a peak leaves such rows out, and such a value at the end is absent.
  /// Elsewhere it is a number that went wrong, and so is the metric that it meets. (For the first value it is never
  /// one.)
  bool may_be_unknown = false;

  Quantity& unknown_at_times() {
    may_be_unknown = true;
    return *this;
  }
  /// Adds a metric: the largest value of the rows, in a unit of its own.
  Quantity& peak(Label name, std::string unit_of_peak, std::string meaning_of_peak, double divisor = 1) {
    metrics.push_back({std::move(name), std::move(unit_of_peak), std::move(meaning_of_peak), Follow::peak, divisor});
    return *this;
  }
  Quantity& peak_magnitude(Label name, std::string meaning_of_peak) {
    metrics.push_back({std::move(name), unit, std::move(meaning_of_peak), Follow::peak_magnitude});
    return *this;
  }
  /// Adds the time of the peak that was added last.
  Quantity& peak_time(Label name) {
    metrics.push_back({std::move(name), "s", "time of the " + metrics.back().meaning, Follow::peak_time});
    return *this;
  }
  /// Whether it must be read at every row.
  [[nodiscard]] bool is_followed() const;
};

/// Takes the value of a row at `time` (s) into the metrics that follow it.
void follow_row(const Quantity& quantity, double value, double time, Metrics& found);
/// Reads what is only known at the end.
void close_books(const Quantity& quantity, Metrics& found);

}  // namespace lahar::cases
