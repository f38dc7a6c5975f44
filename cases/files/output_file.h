#pragma once
// What all writers of result files share: one exception type and one way to replace a file in a single stroke.
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

namespace lahar::cases {

/// A result file that cannot be written or read. The message starts with the file's name.
class FileError : public std::runtime_error {
 public:
  FileError(std::filesystem::path path, const std::string& cause)
      : std::runtime_error(path.string() + ": " + cause), path_(std::move(path)) {}
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Lets `write` fill a temporary file beside `path`, then renames it, so that `path` always holds a complete file.
/// The temporary file is removed if `write` throws. Throws FileError if the rename fails.
void replace_file(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write);

/// Brings a file to the disk, not only to the operating system. Throws FileError.
void sync_file(const std::filesystem::path& path);

/// Replaces `path` by a file that holds `text`, which is on the disk before the former one goes. Throws FileError.
void replace_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace lahar::cases
