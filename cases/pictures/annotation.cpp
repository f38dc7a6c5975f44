#include "cases/pictures/annotation.h"

#include <fmt/format.h>

#include <algorithm>

#include "cases/pictures/backdrop.h"
#include "cases/pictures/canvas.h"
#include "cases/pictures/colour.h"

namespace lahar::cases {

namespace {

const Colour kInk = from_hex(0x22282e), kFaintInk = from_hex(0x4c555e);
constexpr float kGround = 0.78F;  // opacity of the pale ground, on which letters can be read over any picture
constexpr float kMargin = 24, kPadding = 10, kCorner = 4;

std::string number(double v) { return fmt::format("{:.3g}", v); }

std::string length_label(double metres) { return metres < 0.1 ? number(1000 * metres) + " mm" : number(metres) + " m"; }

// A force in N or kN, whichever reads better.
std::string force_label(double newton) {
  return newton >= 1000 ? number(newton / 1000) + " kN" : number(newton) + " N";
}

struct Legend {
  std::string title, lowest, highest;
  ColourRamp ramp;
};

std::vector<Legend> legends_of(const SolidsInView& view, const PictureStyle& style) {
  std::vector<Legend> legends;
  if (view.full_tension > 0)
    legends.push_back({"wire tension", "0", force_label(view.full_tension), ColourRamp::tension});
  if (view.largest_diameter <= 0) return legends;
  if (style.grain_colour == GrainColour::speed)
    legends.push_back({"grain speed", "0", number(view.full_speed) + " m/s", ColourRamp::speed});
  else if (view.largest_diameter > 1.001 * view.smallest_diameter)
    legends.push_back({"grain diameter", number(1000 * view.smallest_diameter) + " mm",
                       number(1000 * view.largest_diameter) + " mm", ColourRamp::stone});
  return legends;
}

// All lengths are pixels of a picture 720 pixels high; the canvas is scaled to the true one.
class Annotation {
 public:
  Annotation(int width, int height)
      : scale_(static_cast<float>(height) / 720.0F),
        size_(static_cast<float>(width) / scale_, 720),
        canvas_(Canvas::Medium::pixels, size_.x(), size_.y(), scale_) {}

  void title(const std::string& text) {
    const float width = canvas_.text_width(text, kTitle);
    ground(Point(kMargin, kMargin), Point(width, kCapHeight * kTitle.size));
    canvas_.text(Point(kMargin + kPadding, kMargin + kPadding + kCapHeight * kTitle.size), text, kTitle);
  }

  void time(double seconds) {
    const std::string text = "t = " + time_label(seconds);
    const Point inside(canvas_.text_width(text, kText), kCapHeight * kText.size);
    const Point corner(kMargin, size_.y() - kMargin - inside.y() - 2 * kPadding);
    ground(corner, inside);
    canvas_.text(Point(kMargin + kPadding, size_.y() - kMargin - kPadding), text, kText);
    left_ = kMargin + inside.x() + 2 * kPadding + 12;
  }

  // A length at the middle of the picture, to the right of the time.
  void scale_bar(double metres, float pixels) {
    const std::string text = length_label(metres);
    const float length = pixels / scale_, words = canvas_.text_width(text, kText);
    const Point inside(length + 9 + words, kCapHeight * kText.size);
    const Point corner(left_, size_.y() - kMargin - inside.y() - 2 * kPadding);
    ground(corner, inside);
    const Point from = corner + Point(kPadding, kPadding + 0.5F * inside.y()), to = from + Point(length, 0);
    const Pen pen{.colour = kInk, .width = 2};
    canvas_.line(from, to, pen);
    for (const Point& end : {from, to}) canvas_.line(end - Point(0, 5), end + Point(0, 5), pen);
    canvas_.text(Point(to.x() + 9, size_.y() - kMargin - kPadding), text, kText);
  }

  // From the lower right corner upwards.
  void legend(const Legend& legend) {
    const float bar = 10, row = kCapHeight * kSmall.size, gap = 7;
    const Point inside(kBarLength, 2 * row + 2 * gap + bar);
    const Point corner(size_.x() - kMargin - kBarLength - 2 * kPadding, size_.y() - right_ - inside.y() - 2 * kPadding);
    ground(corner, inside);
    const Point start = corner + Point::Constant(kPadding), end = start + Point(kBarLength, 0);
    canvas_.text(start + Point(0, row), legend.title, kSmall);
    canvas_.colour_bar(start + Point(0, row + gap), end + Point(0, row + gap + bar), ramp_anchors(legend.ramp));
    canvas_.text(start + Point(0, inside.y()), legend.lowest, kSmall);
    canvas_.text(end + Point(0, inside.y()), legend.highest, kSmall, Hold::end);
    right_ += inside.y() + 2 * kPadding + 12;
  }

  void lay_over(Image& image) { canvas_.lay_over(image); }

 private:
  void ground(const Point& corner, const Point& inside) {
    canvas_.rectangle(corner, corner + inside + Point::Constant(2 * kPadding), Colour::Ones(), kGround, kCorner);
  }

  inline static const Lettering kTitle{.colour = kInk, .size = 22, .bold = true};
  inline static const Lettering kText{.colour = kInk, .size = 20}, kSmall{.colour = kFaintInk, .size = 15};
  static constexpr float kBarLength = 200;
  float scale_;
  Point size_;
  Canvas canvas_;
  float left_ = kMargin, right_ = kMargin;  // where the next thing goes
};

// A round length of about a tenth of the width of the picture, as it is seen at the middle.
void add_scale_bar(Annotation& annotation, const Camera& camera, int width, int height) {
  const Projection projection(camera, width, height);
  const double pixel = static_cast<double>(projection.pixel_angle()) * (camera.target - camera.eye).norm();
  const double metres = static_cast<double>(round_spacing(0.07 * pixel * width, 1));
  annotation.scale_bar(metres, static_cast<float>(metres / pixel));
}

}  // namespace

std::string time_label(double seconds) {
  return (seconds > 0 && seconds < 0.01 ? number(seconds) : fmt::format("{:.3f}", seconds)) + " s";
}

void annotate(Image& image, const PictureScene& scene, const Camera& camera, const PictureStyle& style,
              const SolidsInView& view) {
  Annotation annotation(image.width(), image.height());
  if (!style.title.empty()) annotation.title(style.title);
  if (style.time_stamp) annotation.time(scene.time_s);
  if (style.legend) {
    add_scale_bar(annotation, camera, image.width(), image.height());
    for (const Legend& legend : legends_of(view, style)) annotation.legend(legend);
  }
  annotation.lay_over(image);
}

}  // namespace lahar::cases
