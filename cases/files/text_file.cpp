#include "cases/files/text_file.h"

#include <fstream>
#include <sstream>

#include "cases/files/output_file.h"

namespace lahar::cases {

std::string read_text_file(const std::filesystem::path& path) {
  const std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) throw FileError(path, "cannot be read");
  return text.str();
}

}  // namespace lahar::cases
