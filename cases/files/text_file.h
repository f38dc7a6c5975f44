#pragma once
// Reads whole files.
#include <filesystem>
#include <string>

namespace lahar::cases {

/// The bytes of a file. Throws FileError.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path);

}  // namespace lahar::cases
