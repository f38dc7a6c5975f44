#include "cases/files/png_file.h"

#include <png.h>

#include "cases/files/output_file.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::cases {
namespace {

Image gradient() {
  Image image(37, 21);
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 37; ++x) image.at(x, y) = Colour(static_cast<float>(x) / 51, static_cast<float>(y) / 51, 1.5F);
  return image;
}

TEST(PngFile, PlainLibraryReadsSizeAndColours) {
  const TestFolder folder;
  write_png(folder / "a.png", gradient());
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&png, (folder / "a.png").c_str()), 0);
  EXPECT_EQ(png.width, 37U);
  EXPECT_EQ(png.height, 21U);
  png.format = PNG_FORMAT_RGB;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(png));
  ASSERT_NE(png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr), 0);
  const std::size_t n = 3 * (20 * 37 + 36);  // the last pixel
  EXPECT_EQ(bytes[n], 36 * 5);
  EXPECT_EQ(bytes[n + 1], 20 * 5);
  EXPECT_EQ(bytes[n + 2], 255) << "too bright must be clamped";
}

TEST(PngFile, ReadsBackItsOwn) {
  const TestFolder folder;
  write_png(folder / "a.png", gradient());
  const Image image = read_png(folder / "a.png");
  EXPECT_EQ(image.width(), 37);
  EXPECT_EQ(image.height(), 21);
  EXPECT_NEAR(image.at(30, 4).x(), 30.0F / 51, 1e-6F);
  EXPECT_NEAR(image.at(30, 4).y(), 4.0F / 51, 1e-6F);
}

TEST(PngFile, ErrorsNameTheFile) {
  const TestFolder folder;
  EXPECT_THROW(write_png(folder / "missing/a.png", gradient()), FileError);
  EXPECT_THROW((void)read_png(folder / "absent.png"), FileError);
  replace_text_file(folder / "text.png", "no picture");
  EXPECT_THROW((void)read_png(folder / "text.png"), FileError);
}

}  // namespace
}  // namespace lahar::cases
