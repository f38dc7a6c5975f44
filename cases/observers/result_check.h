#pragma once
// A number held against a reference.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cases/observers/quantity.h"

namespace lahar::cases {

struct ResultCheck {
  std::string name;
  double value = 0, reference = 0, tolerance = 0;
  bool pass = false;
  std::string source;  ///< where the reference is from
};

/// The check that a metric is 0 within a tolerance; none where there is no such metric.
inline std::vector<ResultCheck> vanishes(const Metrics& metrics, const std::string& metric, std::string check,
                                         double tolerance, std::string source) {
  const auto found = metrics.find(metric);
  if (found == metrics.end()) return {};
  const double value = found->second;
  return {{std::move(check), value, 0, tolerance, std::abs(value) <= tolerance, std::move(source)}};
}

}  // namespace lahar::cases
