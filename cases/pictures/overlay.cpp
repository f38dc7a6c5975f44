#include "cases/pictures/overlay.h"

#include <fmt/format.h>

#include <algorithm>

namespace lahar::cases {

namespace {

const Colour kInk = from_hex(0x2a3138);
const Colour kFaintInk = from_hex(0x59636d);

// All sizes follow the height of the picture; 1 at 720 pixels.
float scale_of(const Image& image) { return static_cast<float>(image.height()) / 720.0F; }

std::string number(double v) { return fmt::format("{:.3g}", v); }

// A force in N or kN, whichever reads better.
std::string force_label(double newton) {
  return newton >= 1000 ? number(newton / 1000) + " kN" : number(newton) + " N";
}

// A pale ground under lettering, so that it can be read over any picture.
void draw_panel(Image& image, const Point& upper_left, const Point& lower_right) {
  fill_rectangle(image, upper_left, lower_right, Colour::Ones(), 0.72F);
}

// One line of text on a panel; the lower left corner of the letters is given.
void draw_label(Image& image, const Point& start, const std::string& text) {
  const float s = scale_of(image), letters = 16 * s, rim = 9 * s;
  draw_panel(image, start - Point(rim, letters + rim), start + Point(text_width(text, letters) + rim, rim + 3 * s));
  draw_text(image, start, text, {kInk, letters});
}

struct Legend {
  std::string title, lowest, highest;
  ColourRamp ramp;
};

// One colour bar whose lower right corner is given; returns the height that it takes.
float draw_legend(Image& image, const Legend& legend, const Point& corner) {
  const float s = scale_of(image), width = 190 * s, height = 9 * s, letters = 9.5F * s;
  const Point lower_left = corner - Point(width, 0);
  const float bar_bottom = corner.y() - letters - 8 * s, bar_top = bar_bottom - height;
  draw_panel(image, Point(lower_left.x() - 9 * s, bar_top - 24 * s), corner + Point(9 * s, 9 * s));
  const int columns = std::max(1, static_cast<int>(width));
  for (int c = 0; c < columns; ++c) {
    const float x = lower_left.x() + static_cast<float>(c);
    const Colour colour = ramp_colour(legend.ramp, (static_cast<float>(c) + 0.5F) / static_cast<float>(columns));
    fill_rectangle(image, Point(x, bar_top), Point(x + 1, bar_bottom), colour);
  }
  const Lettering small{kFaintInk, letters};
  draw_text(image, Point(lower_left.x(), corner.y()), legend.lowest, small);
  draw_text(image, Point(corner.x() - text_width(legend.highest, letters), corner.y()), legend.highest, small);
  draw_text(image, Point(lower_left.x(), bar_top - 7 * s), legend.title, {kInk, letters});
  return corner.y() - bar_top + 41 * s;
}

}  // namespace

void draw_overlay(Image& image, const PictureScene& scene, const PictureStyle& style, const SolidsInView& view) {
  const float s = scale_of(image), margin = 28 * s;
  const auto width = static_cast<float>(image.width()), height = static_cast<float>(image.height());
  if (!style.title.empty()) draw_label(image, Point(margin, margin + 16 * s), style.title);
  if (style.time_stamp) draw_label(image, Point(margin, height - margin), fmt::format("t = {:.3f} s", scene.time_s));
  if (!style.legend) return;
  Point corner(width - margin, height - margin);
  if (view.full_tension > 0)
    corner.y() -=
        draw_legend(image, {"wire tension", "0", force_label(view.full_tension), ColourRamp::tension}, corner);
  if (view.largest_diameter <= 0) return;
  if (style.grain_colour == GrainColour::speed)
    draw_legend(image, {"grain speed", "0", number(view.full_speed) + " m/s", ColourRamp::speed}, corner);
  else if (view.largest_diameter > 1.001 * view.smallest_diameter)
    draw_legend(image,
                {"grain diameter", number(1000 * view.smallest_diameter) + " mm",
                 number(1000 * view.largest_diameter) + " mm", ColourRamp::stone},
                corner);
}

}  // namespace lahar::cases
