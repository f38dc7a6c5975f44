#include "cases/files/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace lahar::cases {

void sync_file(const std::filesystem::path& path) {
  const int handle = ::open(path.c_str(), O_RDONLY);
  const bool synced = handle >= 0 && ::fsync(handle) == 0;
  if (handle >= 0) ::close(handle);
  if (!synced) throw FileError(path, "cannot be brought to the disk");
}

void replace_file(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write) {
  std::filesystem::path temporary = path;
  temporary += ".part";
  std::error_code ignored;
  try {
    write(temporary);
  } catch (...) {
    std::filesystem::remove(temporary, ignored);
    throw;
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (!error) return;
  std::filesystem::remove(temporary, ignored);
  throw FileError(path, "cannot be replaced: " + error.message());
}

void replace_text_file(const std::filesystem::path& path, const std::string& text) {
  replace_file(path, [&](const std::filesystem::path& temporary) {
    errno = 0;
    std::ofstream out(temporary, std::ios::binary);
    if (!out) throw FileError(path, std::string("cannot be created: ") + std::strerror(errno));
    out << text;
    out.close();
    if (!out) throw FileError(path, std::string("cannot be written: ") + std::strerror(errno));
    sync_file(temporary);
  });
}

}  // namespace lahar::cases
