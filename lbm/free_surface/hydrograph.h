#pragma once
// Discharge over time: straight lines between given points, nothing before the first and after the last.
#include <algorithm>
#include <vector>

namespace lahar::lbm {

struct HydrographPoint {
  double time = 0;       ///< s
  double discharge = 0;  ///< m^3/s
};

struct Hydrograph {
  std::vector<HydrographPoint> points;  ///< times rising

  /// Volume that has come in up to a time, m^3: exact, so that steps of any length add up to the same.
  [[nodiscard]] double volume_until(double time) const {
    double volume = 0;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const auto &a = points[k], &b = points[k + 1];
      const double end = std::min(time, b.time);
      if (end <= a.time) break;
      const double there = a.discharge + (b.discharge - a.discharge) * (end - a.time) / (b.time - a.time);
      volume += 0.5 * (a.discharge + there) * (end - a.time);
    }
    return volume;
  }
  [[nodiscard]] double peak() const {
    double most = 0;
    for (const auto& p : points) most = std::max(most, p.discharge);
    return most;
  }
};

}  // namespace lahar::lbm
