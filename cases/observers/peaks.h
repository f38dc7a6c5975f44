#pragma once
// The largest value of a series and when it was.
#include <map>
#include <string>

namespace lahar::cases {

/// Notes `value` at `time` (s) in the metrics NAME_peak_UNIT and NAME_peak_time_s if it is the largest so far and above
/// 0.
inline void note_peak(std::map<std::string, double>& metrics, const std::string& name, const std::string& unit,
                      double value, double time) {
  auto& peak = metrics[name + "_peak_" + unit];
  auto& when = metrics[name + "_peak_time_s"];
  if (value <= peak) return;
  peak = value;
  when = time;
}

}  // namespace lahar::cases
