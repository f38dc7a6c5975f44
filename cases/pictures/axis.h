#pragma once
// Axes of charts: what they cover, where their ticks are, how numbers are written at them.
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lahar::cases {

enum class AxisScale { linear, logarithmic };

struct Axis {
  std::string label{}, unit{};  ///< text as in text_markup
  AxisScale scale = AxisScale::linear;
  std::optional<double> low{}, high{};  ///< ends; otherwise round numbers that cover the data
};

/// The range of some values. Those that an axis cannot show (not finite, or not above 0 on a logarithmic one) are left
/// out.
struct DataRange {
  AxisScale scale;
  double low, high;  ///< low > high without a value
  explicit DataRange(AxisScale scale);
  [[nodiscard]] bool shows(double value) const;
  void include(double value);
};

/// An axis with its ticks.
struct AxisTicks {
  AxisScale scale = AxisScale::linear;
  double low = 0, high = 1;          ///< ends
  std::vector<double> major, minor;  ///< rising
  std::vector<std::string> labels;   ///< of the major ticks: value / 10^exponent
  int exponent = 0;                  ///< a multiple of 3; 0 on a logarithmic axis

  /// Where a value lies: 0 at the lower end, 1 at the upper.
  [[nodiscard]] double share(double value) const;
};

/// Ticks for an axis with about `count` steps of 1, 2 or 5 times a power of ten; ends that the axis leaves open are the
/// next ticks beyond the data. Throws std::logic_error for a logarithmic axis that reaches 0.
[[nodiscard]] AxisTicks ticks_of(const Axis& axis, const DataRange& data, int count);

/// Label and unit as they stand at the axis: "force (10^{3} kN)".
[[nodiscard]] std::string axis_title(const Axis& axis, const AxisTicks& ticks);

}  // namespace lahar::cases
