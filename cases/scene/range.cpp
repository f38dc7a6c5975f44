#include "cases/scene/range.h"

#include <fmt/format.h>

#include <cmath>

namespace lahar::scene {

std::string Range::text() const {
  const std::string low = fmt::format("{} {:g}", lower_open ? "above" : "at least", lower);
  const std::string high = fmt::format("{} {:g}", upper_open ? "below" : "at most", upper);
  if (unlimited()) return "";
  if (std::isinf(upper)) return low;
  if (std::isinf(lower)) return high;
  if (!lower_open && !upper_open) return fmt::format("from {:g} to {:g}", lower, upper);
  return low + " and " + high;
}

}  // namespace lahar::scene
