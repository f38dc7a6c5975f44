#include "cases/pictures/canvas.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "cases/pictures/colour.h"

namespace lahar::cases {
namespace {

// Amount of black ink on a white picture, in pixels.
double ink(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) sum += 1 - static_cast<double>(image.at(x, y).x());
  return sum;
}

template <class Draw>
Image drawn(int size, const Draw& draw) {
  Canvas canvas(Canvas::Medium::pixels, static_cast<float>(size), static_cast<float>(size));
  draw(canvas);
  Image image(size, size);
  canvas.lay_over(image);
  return image;
}

TEST(Canvas, LinesAndAreasCoverTheirTrueSize) {
  const double length = std::hypot(119.9, 120.4);
  EXPECT_NEAR(ink(drawn(200,
                        [](Canvas& c) {
                          c.line({30.3F, 40.7F}, {150.2F, 161.1F}, {.width = 8});
                        })),
              8 * length + 16 * std::numbers::pi, 0.01 * 8 * length);
  EXPECT_NEAR(ink(drawn(50,
                        [](Canvas& c) {
                          c.rectangle({3.25F, 4.5F}, {20.75F, 30.25F}, Colour::Zero());
                        })),
              17.5 * 25.75, 2);
  EXPECT_NEAR(ink(drawn(50,
                        [](Canvas& c) {
                          c.disc({25, 25}, 10, Colour::Zero(), {.width = 0});
                        })),
              100 * std::numbers::pi, 3);
}

TEST(Canvas, DashesLeaveGaps) {
  const auto line = [](std::vector<double> dashes) {
    return ink(drawn(100, [&](Canvas& c) { c.line({0, 50}, {100, 50}, {.width = 2, .dashes = dashes}); }));
  };
  EXPECT_NEAR(line({5, 5}) / line({}), 0.5, 0.03);
}

TEST(Canvas, TranslucentAreasMixWithWhatIsBelow) {
  Image image(10, 10, from_hex(0x804020));
  Canvas canvas(Canvas::Medium::pixels, 10, 10);
  canvas.rectangle({0, 0}, {10, 5}, Colour::Ones(), 0.5F);
  canvas.lay_over(image);
  EXPECT_NEAR(image.at(5, 2).x(), 0.5F * (1 + from_hex(0x804020).x()), 0.01F);
  EXPECT_TRUE(image.at(5, 7) == from_hex(0x804020)) << "untouched pixels keep their bits";
}

TEST(Canvas, NothingIsDrawnOutsideTheClip) {
  const Image image = drawn(40, [](Canvas& c) {
    c.clip({0, 0}, {20, 40});
    c.rectangle({0, 0}, {40, 40}, Colour::Zero());
    c.unclip();
  });
  EXPECT_NEAR(ink(image), 800, 1e-3);
}

TEST(Canvas, TextStaysInItsBoxAndScales) {
  const std::string text = "Net 12.5 kN";
  Canvas canvas(Canvas::Medium::pixels, 400, 400);
  const Lettering lettering{.size = 40};
  const float width = canvas.text_width(text, lettering);
  const Image image = drawn(400, [&](Canvas& c) { c.text({50, 270}, text, lettering); });
  const float top = 270 - kCapHeight * 40;
  double outside = 0;
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x) {
      const auto u = static_cast<float>(x), v = static_cast<float>(y);
      if (u < 48 || u > 52 + width || v < top - 3 || v > 273) outside += 1 - static_cast<double>(image.at(x, y).x());
    }
  EXPECT_EQ(outside, 0);
  EXPECT_GT(ink(image), 700);
  EXPECT_NEAR(canvas.text_width(text, {.size = 80}), 2 * width, 0.1F);
  EXPECT_EQ(canvas.text_width("", lettering), 0);
  EXPECT_FLOAT_EQ(canvas.text_width("111", lettering), canvas.text_width("888", lettering)) << "a clock would jitter";
}

TEST(Canvas, TextIsHeldAndTurnedAsAsked) {
  const auto middle_of = [](const Image& image) {
    Eigen::Vector2d sum(0, 0);
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x) sum += (1 - static_cast<double>(image.at(x, y).x())) * Eigen::Vector2d(x, y);
    return Eigen::Vector2d(sum / ink(image));
  };
  const auto text = [&](Hold hold, float degrees) {
    return middle_of(drawn(200, [&](Canvas& c) { c.text({100, 100}, "oooooo", {.size = 20}, hold, degrees); }));
  };
  EXPECT_GT(text(Hold::start, 0).x(), 120);
  EXPECT_NEAR(text(Hold::middle, 0).x(), 100, 1);
  EXPECT_LT(text(Hold::end, 0).x(), 80);
  EXPECT_LT(text(Hold::start, 90).y(), 80) << "upwards";
}

TEST(TextMarkup, RaisesLowersAndEscapes) {
  EXPECT_EQ(text_markup("a < b & c", 10), "a &lt; b &amp; c");
  EXPECT_EQ(text_markup("-5 to -3, CFD-DEM, 2-3", 10), "\u22125 to \u22123, CFD-DEM, 2-3");
  EXPECT_NE(text_markup("m^{2}", 10).find("<span "), std::string::npos);
  EXPECT_EQ(text_markup("a^b_c", 10), "a^b_c");
  EXPECT_EQ(text_markup("m^{2", 10), "m^{2");
}

TEST(TextMarkup, RaisedLettersAreSmallAndHigh) {
  Canvas canvas(Canvas::Medium::pixels, 100, 100);
  const Lettering lettering{.size = 20};
  for (int again = 0; again < 3; ++again) {
    const float plain = canvas.text_width("m2", lettering), raised = canvas.text_width("m^{2}", lettering);
    EXPECT_LT(raised, 0.95F * plain);
    EXPECT_GT(raised, 0.8F * plain);
  }
  const auto highest = [](const char* text) {
    const Image image = drawn(100, [&](Canvas& c) { c.text({10, 60}, text, {.size = 20}); });
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 100; ++x)
        if (image.at(x, y).x() < 0.5F) return y;
    return 100;
  };
  EXPECT_LT(highest("x^{2}"), highest("x2"));
  EXPECT_GT(highest("x_{2}"), highest("x2"));
}

TEST(Canvas, RefusesMisuse) {
  Canvas canvas(Canvas::Medium::pixels, 20, 20);
  Image other(30, 20);
  EXPECT_THROW(canvas.lay_over(other), std::logic_error);
  EXPECT_THROW((void)canvas.document(), std::logic_error);
  EXPECT_THROW(Canvas(Canvas::Medium::pixels, -5, 20), std::logic_error);
}

}  // namespace
}  // namespace lahar::cases
