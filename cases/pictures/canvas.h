#pragma once
// Lines, areas and lettering in two dimensions, by Cairo and Pango: on pixels, or as a vector file. The same input
// gives the same bytes on one machine: nothing holds a date.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cases/files/image.h"
#include "cases/pictures/ray.h"

namespace lahar::cases {

struct Pen {
  Colour colour = Colour::Zero();
  float width = 1;
  std::vector<double> dashes{};  ///< lengths on, off, on...; empty: solid
};

struct Lettering {
  Colour colour = Colour::Zero();
  float size = 10;  ///< of the font; a capital letter is kCapHeight of it high
  bool bold = false;
};
inline constexpr float kCapHeight = 0.72F;

/// Where a line of text is held: at its start, middle or end.
enum class Hold { start, middle, end };

/// Pango markup for text in which ^{...} is raised and _{...} is lowered, as in "kg m^{-3}". A hyphen before a digit
/// that follows neither a letter nor a digit becomes a minus sign. A brace that is not closed stays as it is. `size` is
/// that of the font.
[[nodiscard]] std::string text_markup(const std::string& text, float size);

class Canvas {
 public:
  enum class Medium { pixels, svg, pdf };
  /// Size in units of the canvas: points of 1/72 inch in a vector file, `scale` pixels otherwise. Nothing is drawn yet:
  /// the ground is transparent.
  Canvas(Medium medium, float width, float height, float scale = 1);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void line(std::span<const Point> points, const Pen& pen);
  void line(const Point& from, const Point& to, const Pen& pen);
  /// A closed area, with a rim where `rim.width` is above 0.
  void area(std::span<const Point> corners, const Colour& colour, float opacity = 1, const Pen& rim = {.width = 0});
  void rectangle(const Point& upper_left, const Point& lower_right, const Colour& colour, float opacity = 1,
                 float corner_radius = 0);
  void disc(const Point& centre, float radius, const Colour& colour, const Pen& rim);
  /// A rectangle filled from left to right with these colours, equally far apart.
  void colour_bar(const Point& upper_left, const Point& lower_right, std::span<const Colour> colours);
  /// One line of text (see text_markup) held on its baseline, turned anticlockwise by `degrees`.
  void text(const Point& at, const std::string& text, const Lettering& lettering, Hold hold = Hold::start,
            float degrees = 0);
  [[nodiscard]] float text_width(const std::string& text, const Lettering& lettering);
  /// What is drawn until the next call lies inside this rectangle only.
  void clip(const Point& upper_left, const Point& lower_right);
  void unclip();

  /// Lays what was drawn over a picture of the same size in pixels.
  void lay_over(Image& image);
  /// The vector file. Nothing can be drawn after it.
  [[nodiscard]] std::string document();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace lahar::cases
