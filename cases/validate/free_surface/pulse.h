#pragma once
// What is read off a load that begins with an impact: samples in time, evenly or not.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lahar::validate {

/// A value holds from its time until that of the next sample.
struct Samples {
  std::vector<double> time{}, value{};
};

/// Samples [first, last); that at `last` says when it ends.
struct Window {
  std::size_t first = 0, last = 0;
};

/// From a sample on, for so long.
inline Window window_from(const Samples& s, std::size_t first, double duration) {
  std::size_t last = first;
  while (last + 1 < s.time.size() && s.time[last] < s.time[first] + duration) ++last;
  return {first, last};
}

inline double integral(const Samples& s, const Window& w) {
  double sum = 0;
  for (std::size_t k = w.first; k < w.last; ++k) sum += s.value[k] * (s.time[k + 1] - s.time[k]);
  return sum;
}

inline double mean(const Samples& s, const Window& w) { return integral(s, w) / (s.time[w.last] - s.time[w.first]); }

/// The stretch of `span` within a window whose mean is largest.
inline Window largest_mean(const Samples& s, const Window& within, double span) {
  Window best = window_from(s, within.first, span);
  for (std::size_t k = within.first; k < within.last; ++k) {
    const Window w = window_from(s, k, span);
    if (w.last > within.last) break;
    if (mean(s, w) > mean(s, best)) best = w;
  }
  return best;
}

/// RMS of what a mean over 5 ms takes away, over the mean, from 10 ms on.
inline double ringing(const Samples& s, const Window& within) {
  double squares = 0, sum = 0;
  int count = 0;
  for (std::size_t k = within.first; k < within.last; ++k) {
    const auto half = static_cast<std::size_t>(0.0025 / (s.time[k + 1] - s.time[k]));
    if (s.time[k] < s.time[within.first] + 0.010 || k < half || k + half >= s.value.size()) continue;
    double local = 0;
    for (std::size_t i = k - half; i <= k + half; ++i) local += s.value[i] / static_cast<double>(2 * half + 1);
    squares += (s.value[k] - local) * (s.value[k] - local), sum += s.value[k], ++count;
  }
  return std::sqrt(squares * count) / sum;
}

/// A pulse that rises and falls along straight lines: its largest mean over `span`, over its peak. The stretch that has
/// it begins and ends at the same height, span / (rise + decay) below the peak.
inline double largest_mean_of_triangle(double span, double rise, double decay) {
  return 1 - span / (2 * (rise + decay));
}

}  // namespace lahar::validate
