#pragma once
// Whether a scene's check warns of something.
#include <algorithm>
#include <string>

#include "cases/runner/check.h"

namespace lahar::cases {

/// True if one of the warnings has this text in it.
inline bool warns(const CheckReport& report, const std::string& part) {
  return std::any_of(report.warnings.begin(), report.warnings.end(),
                     [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
}

}  // namespace lahar::cases
