#pragma once
// Smooth-edged lines, rectangles and lettering on an Image. Coordinates are pixels from the upper left corner; pixel
// (0,0) has its centre at (0.5, 0.5).
#include <Eigen/Core>
#include <span>
#include <string_view>

#include "cases/pictures/image.h"

namespace lahar::cases {

using Point = Eigen::Vector2f;

struct Pen {
  Colour colour = Colour::Zero();
  float width = 1;    ///< pixels
  float opacity = 1;  ///< 0..1
};

/// A connected line with round ends and joints.
void draw_line(Image& image, std::span<const Point> points, const Pen& pen);
void draw_line(Image& image, const Point& from, const Point& to, const Pen& pen);

/// The rectangle with the given corners.
void fill_rectangle(Image& image, const Point& upper_left, const Point& lower_right, const Colour& colour,
                    float opacity = 1);

/// How lettering looks: drawn with strokes, so that any height is smooth.
struct Lettering {
  Colour colour = Colour::Zero();
  float height = 14;     ///< of a capital letter, pixels
  float weight = 0.12F;  ///< stroke width over height
  float opacity = 1;     ///< 0..1
};

/// Writes one line of text whose baseline starts at `start`. Known are ASCII letters, digits and common signs; anything
/// else appears as an empty box.
void draw_text(Image& image, const Point& start, std::string_view text, const Lettering& lettering);
/// Width of a line of text in pixels.
[[nodiscard]] float text_width(std::string_view text, float height);

}  // namespace lahar::cases
