#include "cases/pictures/drawing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "cases/pictures/glyphs.h"

namespace lahar::cases {
namespace {

// Amount of black ink on a white picture, in pixels.
double ink(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) sum += 1 - image.at(x, y).x();
  return sum;
}

TEST(Drawing, ALineCoversLengthTimesWidthPlusRoundEnds) {
  Image image(200, 200);
  draw_line(image, Point(30.3F, 40.7F), Point(150.2F, 161.1F), {Colour::Zero(), 8, 1});
  const double length = std::hypot(119.9, 120.4);
  EXPECT_NEAR(ink(image), 8 * length + 16 * std::numbers::pi, 0.01 * 8 * length);
}

TEST(Drawing, JointsOfATranslucentLineAreNotDarker) {
  Image image(60, 60);
  const std::array<Point, 3> bend{Point(10, 30), Point(30, 30), Point(50, 30)};
  draw_line(image, bend, {Colour::Zero(), 6, 0.5F});
  EXPECT_NEAR(image.at(30, 30).x(), 0.5F, 1e-6F);
  EXPECT_NEAR(image.at(20, 30).x(), 0.5F, 1e-6F);
}

TEST(Drawing, AHairlineIsFaintNotMissing) {
  Image image(100, 20);
  draw_line(image, Point(0, 10.5F), Point(100, 10.5F), {Colour::Zero(), 0.25F, 1});
  EXPECT_NEAR(ink(image), 25, 0.5);
}

TEST(Drawing, ARectangleCoversItsExactArea) {
  Image image(50, 50);
  fill_rectangle(image, Point(3.25F, 4.5F), Point(20.75F, 30.25F), Colour::Zero());
  EXPECT_NEAR(ink(image), 17.5 * 25.75, 1e-2);
  fill_rectangle(image, Point(-9, -9), Point(99, 99), Colour::Zero());
  EXPECT_NEAR(ink(image), 2500, 1e-2);
}

TEST(Drawing, TextStaysInItsBoxAndScales) {
  const std::string text = "Net 12.5 kN";
  Image image(400, 100);
  draw_text(image, Point(50, 70), text, {Colour::Zero(), 30});
  const float right = 50 + text_width(text, 30);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 400; ++x)
      if (static_cast<float>(x) < 46 || static_cast<float>(x) > right + 4 || y < 36 || y > 74) {
        EXPECT_EQ(image.at(x, y).x(), 1) << x << " " << y;
      }
  EXPECT_GT(ink(image), 500);
  EXPECT_FLOAT_EQ(text_width(text, 60), 2 * text_width(text, 30));
  EXPECT_EQ(text_width("", 30), 0);
}

TEST(Glyphs, DigitsShareOneWidthAndLettersDiffer) {
  for (char c = '1'; c <= '9'; ++c) EXPECT_EQ(glyph_of(c).width, glyph_of('0').width) << c;
  const auto picture = [](char c) {
    Image image(24, 24);
    draw_text(image, Point(4, 18), std::string(1, c), {Colour::Zero(), 14});
    return ink(image) + 1e-3 * static_cast<double>(image.at(8, 11).x()) + 1e-3 * image.at(5, 8).x();
  };
  const std::string all = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789.,:;!?-+=/()[]%_^'*<>|";
  for (const char c : all) EXPECT_GT(picture(c), 1) << c << " is blank";
  for (const char c : all) EXPECT_NE(&glyph_of(c), &glyph_of('\x01')) << c << " is missing";
  EXPECT_NE(picture('O'), picture('Q'));
}

}  // namespace
}  // namespace lahar::cases
