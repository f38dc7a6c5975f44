#pragma once
// Pictures inside pages that need no other file.
#include <filesystem>
#include <string>

namespace lahar::cases {

/// An <img> element that holds the bytes of a .png or .svg file. Drawings are images too: as elements of one document
/// they would share the names of their glyphs and clips, which each file counts from 0. Throws FileError.
[[nodiscard]] std::string html_image(const std::filesystem::path& file);

/// RFC 4648.
[[nodiscard]] std::string base64(const std::string& bytes);

}  // namespace lahar::cases
