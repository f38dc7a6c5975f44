#pragma once
#include <cstdio>
#include <string>

namespace lahar {

/// A number in a message, as people write it: six digits at most.
inline std::string number_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

}  // namespace lahar
