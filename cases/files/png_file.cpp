#include "cases/files/png_file.h"

#include <png.h>

#include <cmath>
#include <string>
#include <vector>

#include "cases/files/output_file.h"

namespace lahar::cases {

namespace {

png_image header(int width, int height) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(width);
  png.height = static_cast<png_uint_32>(height);
  png.format = PNG_FORMAT_RGB;
  return png;
}

std::vector<png_byte> to_bytes(const Image& image) {
  std::vector<png_byte> bytes;
  bytes.reserve(3 * static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (const float v : image.at(x, y))
        bytes.push_back(static_cast<png_byte>(std::lround(255 * std::clamp(v, 0.0F, 1.0F))));
  return bytes;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image) {
  const std::vector<png_byte> bytes = to_bytes(image);
  png_image png = header(image.width(), image.height());
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string file(size, '\0');
  if (png_image_write_to_memory(&png, file.data(), &size, 0, bytes.data(), 0, nullptr) == 0)
    throw FileError(path, std::string("cannot be encoded: ") + png.message);
  file.resize(size);
  replace_text_file(path, file);
}

Image read_png(const std::filesystem::path& path) {
  png_image png = header(0, 0);
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0)
    throw FileError(path, std::string("cannot be read: ") + png.message);
  png.format = PNG_FORMAT_RGB;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr) == 0)
    throw FileError(path, std::string("cannot be read: ") + png.message);
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  for (int y = 0, n = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (float& v : image.at(x, y)) v = static_cast<float>(bytes[static_cast<std::size_t>(n++)]) / 255.0F;
  return image;
}

}  // namespace lahar::cases
