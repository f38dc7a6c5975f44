#pragma once
// A picture in memory: display colours, row by row from the top.
#include <algorithm>
#include <vector>

#include "core/vector.h"

namespace lahar::cases {

/// Red, green, blue in 0..1.
using Colour = Eigen::Vector3f;

class Image {
 public:
  Image(int width, int height, const Colour& fill = Colour::Ones())
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// The pixel in column x (from the left) and row y (from the top).
  [[nodiscard]] Colour& at(int x, int y) { return pixels_[index(x, y)]; }
  [[nodiscard]] const Colour& at(int x, int y) const { return pixels_[index(x, y)]; }
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  /// Lays a colour of the given opacity over a pixel; outside the picture nothing happens.
  void blend(int x, int y, const Colour& colour, float opacity) {
    if (contains(x, y)) at(x, y) += std::min(opacity, 1.0F) * (colour - at(x, y));
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_, height_;
  std::vector<Colour> pixels_;
};

}  // namespace lahar::cases
