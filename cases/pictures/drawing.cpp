#include "cases/pictures/drawing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cases/pictures/glyphs.h"

namespace lahar::cases {

namespace {

constexpr float kLetterSpace = 1.7F;  // between letters, in sixths of the capital height

float distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point ab = b - a;
  const float length2 = ab.squaredNorm();
  const float t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0F, 1.0F) : 0.0F;
  return (p - a - t * ab).norm();
}

// How much of each pixel in a window the line covers. Segments are merged by their maximum, so that joints of a
// translucent line are not darker than the rest.
class Coverage {
 public:
  Coverage(const Image& image, std::span<const Point> points, float reach) {
    Point lower = points[0], upper = points[0];
    for (const Point& p : points) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
    x0_ = std::clamp(static_cast<int>(std::floor(lower.x() - reach)), 0, image.width());
    y0_ = std::clamp(static_cast<int>(std::floor(lower.y() - reach)), 0, image.height());
    x1_ = std::clamp(static_cast<int>(std::ceil(upper.x() + reach)), x0_, image.width());
    y1_ = std::clamp(static_cast<int>(std::ceil(upper.y() + reach)), y0_, image.height());
    share_.assign(static_cast<std::size_t>(x1_ - x0_) * static_cast<std::size_t>(y1_ - y0_), 0.0F);
  }

  void add_segment(const Point& a, const Point& b, float half_width) {
    const float reach = half_width + 1;
    const int left = std::max(x0_, static_cast<int>(std::floor(std::min(a.x(), b.x()) - reach)));
    const int right = std::min(x1_, static_cast<int>(std::ceil(std::max(a.x(), b.x()) + reach)));
    const int top = std::max(y0_, static_cast<int>(std::floor(std::min(a.y(), b.y()) - reach)));
    const int bottom = std::min(y1_, static_cast<int>(std::ceil(std::max(a.y(), b.y()) + reach)));
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) {
        const Point centre(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        float& share = at(x, y);
        share = std::max(share, std::clamp(half_width + 0.5F - distance_to_segment(centre, a, b), 0.0F, 1.0F));
      }
  }

  void paint(Image& image, const Colour& colour, float opacity) {
    for (int y = y0_; y < y1_; ++y)
      for (int x = x0_; x < x1_; ++x)
        if (at(x, y) > 0) image.blend(x, y, colour, opacity * at(x, y));
  }

 private:
  [[nodiscard]] float& at(int x, int y) {
    return share_[static_cast<std::size_t>(y - y0_) * static_cast<std::size_t>(x1_ - x0_) +
                  static_cast<std::size_t>(x - x0_)];
  }
  int x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;
  std::vector<float> share_;
};

}  // namespace

void draw_line(Image& image, std::span<const Point> points, const Pen& pen) {
  if (points.empty()) return;
  // A line thinner than a pixel is drawn one pixel wide and fainter.
  const float half_width = 0.5F * std::max(pen.width, 1.0F);
  Coverage coverage(image, points, half_width + 1);
  for (std::size_t i = 0; i < std::max<std::size_t>(1, points.size() - 1); ++i)
    coverage.add_segment(points[i], points[std::min(i + 1, points.size() - 1)], half_width);
  coverage.paint(image, pen.colour, pen.opacity * std::min(pen.width, 1.0F));
}

void draw_line(Image& image, const Point& from, const Point& to, const Pen& pen) {
  const std::array<Point, 2> ends{from, to};
  draw_line(image, ends, pen);
}

void fill_rectangle(Image& image, const Point& upper_left, const Point& lower_right, const Colour& colour,
                    float opacity) {
  const auto overlap = [](int pixel, float from, float to) {
    return std::clamp(std::min(to, static_cast<float>(pixel + 1)) - std::max(from, static_cast<float>(pixel)), 0.0F,
                      1.0F);
  };
  const int x0 = std::max(0, static_cast<int>(std::floor(upper_left.x())));
  const int y0 = std::max(0, static_cast<int>(std::floor(upper_left.y())));
  const int x1 = std::min(image.width(), static_cast<int>(std::ceil(lower_right.x())));
  const int y1 = std::min(image.height(), static_cast<int>(std::ceil(lower_right.y())));
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      image.blend(x, y, colour,
                  opacity * overlap(x, upper_left.x(), lower_right.x()) * overlap(y, upper_left.y(), lower_right.y()));
}

void draw_text(Image& image, const Point& start, std::string_view text, const Lettering& lettering) {
  const float unit = lettering.height / 6;
  const Pen pen{lettering.colour, lettering.weight * lettering.height, lettering.opacity};
  Point cursor = start;
  std::vector<Point> line;
  for (const char character : text) {
    const Glyph& glyph = glyph_of(character);
    for (const auto& stroke : glyph.strokes) {
      line.clear();
      for (const auto& point : stroke) line.emplace_back(cursor.x() + unit * point.x(), cursor.y() - unit * point.y());
      draw_line(image, line, pen);
    }
    cursor.x() += unit * (glyph.width + kLetterSpace);
  }
}

float text_width(std::string_view text, float height) {
  float width = 0;
  for (const char character : text) width += glyph_of(character).width + kLetterSpace;
  return text.empty() ? 0 : (width - kLetterSpace) * height / 6;
}

}  // namespace lahar::cases
