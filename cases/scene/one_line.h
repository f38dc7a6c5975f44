#pragma once
// Texts of the user (names, files, values) in messages.
#include <fmt/format.h>

#include <string>
#include <string_view>

namespace lahar::scene {

/// A text as messages show it: control characters, on which a terminal may act, as TOML writes them (\u000A). They are
/// U+0000 to U+001F, U+007F and, two bytes each in UTF-8, U+0080 to U+009F.
inline std::string on_one_line(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool two_bytes = byte(i) == 0xc2 && byte(i + 1) >= 0x80 && byte(i + 1) <= 0x9f;
    if (two_bytes) ++i;  // the second is its number
    if (two_bytes || byte(i) < 0x20 || byte(i) == 0x7f)
      line += fmt::format("\\u{:04X}", byte(i));
    else
      line += text[i];
  }
  return line;
}

}  // namespace lahar::scene
