#pragma once
// Where the scenes and tables of cases/ lie.
#include <filesystem>
#include <string>

namespace lahar::cases {

/// A file of cases/, such as "debris_flow/scene.toml": of an installed program beside it, else in the source folder
/// that it was built from.
std::filesystem::path case_file(const std::string& path);

}  // namespace lahar::cases
