#pragma once
// What a number in a scene may be, and the words that say so.
#include <limits>
#include <string>

namespace lahar::scene {

struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;  ///< the bound itself is not allowed
  bool upper_open = false;

  [[nodiscard]] bool contains(double v) const {
    return (lower_open ? v > lower : v >= lower) && (upper_open ? v < upper : v <= upper);
  }
  [[nodiscard]] bool unlimited() const {
    return lower == -std::numeric_limits<double>::infinity() && upper == std::numeric_limits<double>::infinity();
  }
  /// "above 0", "from 0 to 0.5", "" when unlimited.
  [[nodiscard]] std::string text() const;
};

inline Range positive() { return {.lower = 0, .lower_open = true}; }
inline Range non_negative() { return {.lower = 0}; }
inline Range at_least(double lower) { return {.lower = lower}; }
inline Range between(double lower, double upper) { return {.lower = lower, .upper = upper}; }
inline Range above_up_to(double lower, double upper) { return {.lower = lower, .upper = upper, .lower_open = true}; }

/// What is demanded of one key.
struct Rule {
  Range range{};          ///< of each number
  bool required = false;  ///< no default
  int min_count = 0;      ///< of a list
  int max_count = std::numeric_limits<int>::max();
};

inline Rule required(const Range& range = {}) { return {.range = range, .required = true}; }

}  // namespace lahar::scene
