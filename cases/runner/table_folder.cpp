#include "cases/runner/table_folder.h"

#include <fmt/format.h>

#include <fstream>
#include <vector>

#include "cases/runner/output_folder.h"
#include "core/check.h"

namespace lahar::cases {

namespace fs = std::filesystem;

bool holds_table(const fs::path& file, const std::string& columns) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line))
    if (!line.starts_with('#')) return line == columns;
  return false;
}

void prepare_table_folder(const fs::path& folder, const std::string& table, const std::string& columns,
                          bool overwrite) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(std::vector<InputMistake>{{"--out " + folder.string(), 1, 1, why}});
  };
  std::error_code error;
  if (fs::is_directory(folder, error) && !fs::is_empty(folder, error)) {
    if (!holds_table(folder / table, columns))
      refuse(fmt::format("is not empty and holds no former {}, expected a new or an empty folder", table));
    if (!overwrite)
      refuse(fmt::format("holds a former {}, expected a new folder, or --overwrite to replace it", table));
  }
  create_folder(folder);
}

}  // namespace lahar::cases
