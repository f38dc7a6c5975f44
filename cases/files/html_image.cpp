#include "cases/files/html_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "cases/files/text_file.h"

namespace lahar::cases {

std::string base64(const std::string& bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t three = 0;
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - k);
    for (std::size_t n = 0; n < 3; ++n)
      three = three << 8 | (n < there ? static_cast<unsigned char>(bytes[k + n]) : 0U);
    for (std::size_t n = 0; n < 4; ++n) text += n <= there ? kLetters[three >> (18 - 6 * n) & 63] : '=';
  }
  return text;
}

std::string html_image(const std::filesystem::path& file) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/{};base64,{}\">", file.filename().string(),
                     file.extension() == ".svg" ? "svg+xml" : "png", base64(read_text_file(file)));
}

}  // namespace lahar::cases
