#include "cases/pictures/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace lahar::cases {

namespace {

constexpr double kLogRoom = 1.1;    // beyond the data of a logarithmic axis
constexpr double kRounding = 1e-9;  // of a step: what is nearer to a tick lies on it

// 1, 2 or 5 times a power of ten, at least `rough`.
double round_step(double rough) {
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (rough <= factor * power * (1 + kRounding)) return factor * power;
  return 10 * power;
}

// A step of 2 is divided into halves, 1 and 5 into fifths.
int parts_of(double step) {
  return std::lround(step / std::pow(10, std::floor(std::log10(step) + kRounding))) == 2 ? 4 : 5;
}

std::vector<double> multiples(double low, double high, double step) {
  std::vector<double> values;
  for (double n = std::ceil(low / step - kRounding); n <= high / step + kRounding; ++n) values.push_back(n * step);
  return values;
}

// A constant gets some room around it, and so do numbers that differ by roundings alone.
void make_usable(double& low, double& high, AxisScale scale) {
  const bool logarithmic = scale == AxisScale::logarithmic;
  if (low > high) low = logarithmic ? 1 : 0, high = logarithmic ? 10 : 1;
  if (high - low > 1e-12 * std::max(std::abs(low), std::abs(high))) return;
  if (logarithmic) {
    low /= 2, high *= 2;
  } else {
    const double room = std::max(0.5 * std::abs(low), 0.5);
    low -= room, high += room;
  }
}

// Thousands, millionths... that leave short numbers at the ticks.
int engineering_exponent(double low, double high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  if (largest < 1e4 && largest >= 1e-2) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(largest) / 3 + kRounding));
}

std::string linear_label(double value, double step) {
  if (std::abs(value) < kRounding * step) return "0";
  return fmt::format("{:.{}f}", value, std::max(0, static_cast<int>(std::ceil(-std::log10(step) - kRounding))));
}

// The next major tick, or a minor one with some room where most of the way to the major one would stay empty.
double end_beyond(double value, double step, double fine) {
  const double major = step * std::ceil(value / step - kRounding);
  return major - value <= 0.6 * step ? major : fine * std::ceil(value / fine + 0.5);
}

AxisTicks linear_ticks(const Axis& axis, double low, double high, int count) {
  AxisTicks ticks;
  const double step = round_step((high - low) / count), fine = step / parts_of(step);
  ticks.low = axis.low.value_or(-end_beyond(-low, step, fine));
  ticks.high = axis.high.value_or(end_beyond(high, step, fine));
  ticks.major = multiples(ticks.low, ticks.high, step);
  for (const double v : multiples(ticks.low, ticks.high, fine))
    if (std::abs(std::remainder(v, step)) > 0.1 * fine) ticks.minor.push_back(v);
  ticks.exponent = engineering_exponent(ticks.low, ticks.high);
  const double unit = std::pow(10, ticks.exponent);
  for (const double v : ticks.major) ticks.labels.push_back(linear_label(v / unit, step / unit));
  return ticks;
}

// A power of ten times 1, 2 or 5.
std::string power_label(double value, bool plain) {
  const int power = static_cast<int>(std::floor(std::log10(value) + kRounding));
  if (plain) return fmt::format("{:.{}f}", value, std::max(0, -power));
  const double factor = std::round(value / std::pow(10, power));
  return (factor > 1 ? fmt::format("{:.0f}\u00d7", factor) : "") + fmt::format("10^{{{}}}", power);
}

// The nearest of 1, 2, ... 9 times a power of ten on either side.
double end_below(double value) {
  const double power = std::pow(10, std::floor(std::log10(value) + kRounding));
  return power * std::floor(value / power * (1 + kRounding));
}
double end_above(double value) {
  const double power = std::pow(10, std::floor(std::log10(value) + kRounding));
  return power * std::ceil(value / power * (1 - kRounding));
}

AxisTicks logarithmic_ticks(const Axis& axis, double low, double high, int count) {
  AxisTicks ticks;
  ticks.scale = AxisScale::logarithmic;
  ticks.low = axis.low.value_or(end_below(low / kLogRoom));
  ticks.high = axis.high.value_or(end_above(high * kLogRoom));
  const double decades = std::log10(ticks.high / ticks.low);
  const int every = std::max(1, static_cast<int>(std::ceil(decades / count)));
  const int first = static_cast<int>(std::floor(std::log10(ticks.low) + kRounding));
  const auto inside = [&](double v) { return v >= ticks.low * (1 - kRounding) && v <= ticks.high * (1 + kRounding); };
  const bool plain = ticks.low >= 0.999e-3 && ticks.high <= 1.001e4;
  for (int power = first; std::pow(10, power) <= ticks.high * (1 + kRounding); ++power)
    for (int factor = 1; factor < 10; ++factor) {
      const double value = factor * std::pow(10, power);
      if (!inside(value)) continue;
      const bool named = decades < 2 ? factor == 1 || factor == 2 || factor == 5 : factor == 1 && power % every == 0;
      (named ? ticks.major : ticks.minor).push_back(value);
      if (named) ticks.labels.push_back(power_label(value, plain));
    }
  return ticks;
}

}  // namespace

DataRange::DataRange(AxisScale axis_scale)
    : scale(axis_scale), low(std::numeric_limits<double>::infinity()), high(-low) {}

bool DataRange::shows(double value) const { return std::isfinite(value) && (scale == AxisScale::linear || value > 0); }

void DataRange::include(double value) {
  if (shows(value)) low = std::min(low, value), high = std::max(high, value);
}

double AxisTicks::share(double value) const {
  if (scale == AxisScale::logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

AxisTicks ticks_of(const Axis& axis, const DataRange& data, int count) {
  double low = axis.low.value_or(data.low), high = axis.high.value_or(data.high);
  make_usable(low, high, axis.scale);
  require(axis.scale == AxisScale::linear || low > 0, "ticks_of: a logarithmic axis cannot reach 0");
  return axis.scale == AxisScale::linear ? linear_ticks(axis, low, high, count)
                                         : logarithmic_ticks(axis, low, high, count);
}

std::string axis_title(const Axis& axis, const AxisTicks& ticks) {
  std::string unit = ticks.exponent == 0 ? "" : fmt::format("10^{{{}}}", ticks.exponent);
  if (!axis.unit.empty()) unit += (unit.empty() ? "" : " ") + axis.unit;
  return unit.empty() ? axis.label : axis.label + " (" + unit + ")";
}

}  // namespace lahar::cases
