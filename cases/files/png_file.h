#pragma once
// PNG files, 8 bits per channel.
#include <filesystem>

#include "cases/files/image.h"

namespace lahar::cases {

/// Writes a picture in one stroke (temporary file, then rename). Throws FileError.
void write_png(const std::filesystem::path& path, const Image& image);

/// Reads a picture. Throws FileError.
[[nodiscard]] Image read_png(const std::filesystem::path& path);

}  // namespace lahar::cases
