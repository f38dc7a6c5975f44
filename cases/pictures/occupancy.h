#pragma once
// Which parts of a drawing are taken, so that lettering finds a free place.
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "cases/pictures/ray.h"

namespace lahar::cases {

using PlaneBox = Eigen::AlignedBox2f;

class Occupancy {
 public:
  void add_line(std::span<const Point> points);
  void add_box(const PlaneBox& box);
  /// Whether nothing touches the box.
  [[nodiscard]] bool is_free(const PlaneBox& box) const;

 private:
  std::vector<std::pair<Point, Point>> segments_;
  std::vector<PlaneBox> boxes_;
};

/// Whether a part of the segment lies in the box.
[[nodiscard]] bool touches(const PlaneBox& box, const Point& from, const Point& to);

}  // namespace lahar::cases
