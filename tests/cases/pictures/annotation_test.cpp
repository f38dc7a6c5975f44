#include "cases/pictures/annotation.h"

#include <gtest/gtest.h>

#include "cases/pictures/colour.h"

namespace lahar::cases {
namespace {

const Camera kCamera{Vec3(0, -4, 0.5), Vec3(0, 0, 0.5), Vec3::UnitZ(), 30};

Image annotated(const PictureStyle& style, const SolidsInView& view = {}, double time = 1.25) {
  Image image(640, 360, from_hex(0x6080a0));
  annotate(image, {.box = {}, .time_s = time}, kCamera, style, view);
  return image;
}

// Changed pixels in one of the four corners of the picture (0 upper left, 1 upper right, 2 lower left, 3 lower right).
int changed(const Image& image, int corner) {
  int count = 0;
  for (int y = 180 * (corner / 2); y < 180 * (corner / 2 + 1); ++y)
    for (int x = 320 * (corner % 2); x < 320 * (corner % 2 + 1); ++x) count += image.at(x, y) != from_hex(0x6080a0);
  return count;
}

TEST(Annotation, EachPartStandsInItsCorner) {
  PictureStyle style{.time_stamp = false, .legend = false};
  for (int corner = 0; corner < 4; ++corner) EXPECT_EQ(changed(annotated(style), corner), 0);
  style.title = "Debris flow";
  EXPECT_GT(changed(annotated(style), 0), 1000);
  EXPECT_EQ(changed(annotated(style), 2), 0);
  style.time_stamp = true;
  EXPECT_GT(changed(annotated(style), 2), 1000);
  EXPECT_EQ(changed(annotated(style), 3), 0);
  SolidsInView view;
  view.smallest_diameter = 0.02, view.largest_diameter = 0.08, view.full_tension = 5e3;
  style.legend = true;
  const int both = changed(annotated(style, view), 3);
  view.full_tension = 0;
  const int one = changed(annotated(style, view), 3);
  EXPECT_GT(one, 1000);
  EXPECT_GT(both, 3 * one / 2);
  EXPECT_EQ(changed(annotated(style, view), 1), 0);
}

TEST(Annotation, TheClockRuns) {
  const PictureStyle style{.legend = false};
  const Image now = annotated(style), later = annotated(style, {}, 1.26);
  int different = 0;
  for (int y = 0; y < 360; ++y)
    for (int x = 0; x < 640; ++x) different += now.at(x, y) != later.at(x, y);
  EXPECT_GT(different, 10);
  EXPECT_LT(different, 300) << "all but one digit keep their place";
}

TEST(Annotation, ShortTimesHaveSignificantDigits) {
  for (const auto& [seconds, label] : {std::pair{0.0, "0.000 s"},
                                       {1.25, "1.250 s"},
                                       {0.01, "0.010 s"},
                                       {0.0025, "0.0025 s"},
                                       {1.2345e-4, "0.000123 s"},
                                       {2e-9, "2e-09 s"}})
    EXPECT_EQ(time_label(seconds), label);
  const PictureStyle style{.legend = false};
  const Image now = annotated(style, {}, 2e-9), later = annotated(style, {}, 4e-9);
  int different = 0;
  for (int y = 0; y < 360; ++y)
    for (int x = 0; x < 640; ++x) different += now.at(x, y) != later.at(x, y);
  EXPECT_GT(different, 10);
}

TEST(Annotation, TheScaleBarHasItsTrueLength) {
  const PictureStyle with{.time_stamp = false}, without{.time_stamp = false, .legend = false};
  const Image image = annotated(with);
  // The row of the bar holds the longest run of dark pixels.
  int longest = 0;
  for (int y = 0; y < 360; ++y)
    for (int x = 0, run = 0; x < 640; ++x) {
      run = image.at(x, y).sum() < 0.9F ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  const Projection projection(kCamera, 640, 360);
  const float metre = projection.pixel(Vec3(0.5, 0, 0.5)).x() - projection.pixel(Vec3(-0.5, 0, 0.5)).x();
  const float metres = static_cast<float>(longest) / metre;
  EXPECT_NEAR(metres, 0.5F, 0.02F);
}

}  // namespace
}  // namespace lahar::cases
