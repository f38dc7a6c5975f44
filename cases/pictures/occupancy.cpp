#include "cases/pictures/occupancy.h"

#include <algorithm>

namespace lahar::cases {

// Liang & Barsky 1984: the part of the segment between each pair of sides, cut with the parts before.
bool touches(const PlaneBox& box, const Point& from, const Point& to) {
  float enter = 0, leave = 1;
  const Point along = to - from;
  for (int d = 0; d < 2; ++d) {
    if (along[d] == 0) {
      if (from[d] < box.min()[d] || from[d] > box.max()[d]) return false;
      continue;
    }
    const float a = (box.min()[d] - from[d]) / along[d], b = (box.max()[d] - from[d]) / along[d];
    enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

void Occupancy::add_line(std::span<const Point> points) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) segments_.emplace_back(points[i], points[i + 1]);
}

void Occupancy::add_box(const PlaneBox& box) { boxes_.push_back(box); }

bool Occupancy::is_free(const PlaneBox& box) const {
  return std::none_of(boxes_.begin(), boxes_.end(), [&](const PlaneBox& b) { return b.intersects(box); }) &&
         std::none_of(segments_.begin(), segments_.end(),
                      [&](const auto& segment) { return touches(box, segment.first, segment.second); });
}

}  // namespace lahar::cases
