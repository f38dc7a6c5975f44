#include "cases/files/case_file.h"

namespace lahar::cases {

std::filesystem::path case_file(const std::string& path) {
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  const std::filesystem::path installed = program.parent_path() / LAHAR_DATA_FROM_BIN / "cases";
  return (std::filesystem::is_directory(installed, none) ? installed : LAHAR_CASES_FOLDER) / path;
}

}  // namespace lahar::cases
