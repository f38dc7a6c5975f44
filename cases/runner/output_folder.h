#pragma once
// Folders and files that results go into. What a run wrote is never overwritten unasked, what is not ours is never
// touched, and a place that nothing can be written to is refused before hours of work.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace lahar::cases {

/// What run.log says when the first step begins: from then on the folder holds results.
inline constexpr const char* kStepsBeginMark = "the steps begin";

/// Whether a folder holds a run: a scene.resolved.toml that Lahar wrote.
bool holds_run(const std::filesystem::path& folder);

/// Creates the folder that a command-line option names, if it is not there. Throws InputError where it cannot be made
/// or nothing can be written into it, or a file stands there.
void create_folder(const std::filesystem::path& folder, const std::string& option = "--out");

/// Throws InputError unless the file that a command-line option names can be written. What stands there stays as it is.
void require_writable(const std::filesystem::path& file, const std::string& option);

/// The same for a record that a program keeps in one file. One that stands there is replaced only if it is empty or
/// `is_record` knows its text as one of the program's. Throws InputError otherwise.
void require_record(const std::filesystem::path& file, const std::string& option, const std::string& program,
                    const std::function<bool(const std::string&)>& is_record);

/// Throws InputError if something stands there, below the folder that an option names, that a program must not remove:
/// anything but a run or an empty folder.
void require_run_or_nothing(const std::filesystem::path& place, const std::string& option = "--out");

/// The number in the name of a file that runs write many of: STEM, six digits or more, ENDING; nothing for other names.
std::optional<std::int64_t> number_of_file(std::string_view name, std::string_view stem, std::string_view ending);

/// Keeps other runs out of a folder as long as it lives and the process does, however that ends. Where the file system
/// cannot lock a folder (NFS) nothing is kept out.
class FolderLock {
 public:
  /// Throws InputError if a run is going on in the folder.
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(FolderLock&& other) noexcept : handle_(std::exchange(other.handle_, -1)) {}
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  int handle_;
};

/// The files of a run, known by their names, that another one is to replace. They stand aside, in a folder of their own
/// beside where they were, until it is known that the new run begins; without that they come back.
class FormerRun {
 public:
  FormerRun() = default;
  /// Sets the files aside.
  explicit FormerRun(const std::filesystem::path& folder);
  FormerRun(FormerRun&& other) noexcept : folder_(std::exchange(other.folder_, {})) {}
  FormerRun(const FormerRun&) = delete;
  FormerRun& operator=(const FormerRun&) = delete;
  FormerRun& operator=(FormerRun&&) = delete;
  /// Puts them back, in place of what was written since, unless they were removed.
  ~FormerRun();
  /// The new run has begun: they are removed.
  void remove();
  /// Puts back what a process has left aside that was killed, at whatever moment.
  static void recover(const std::filesystem::path& folder);

 private:
  std::filesystem::path folder_;  // empty: none
};

struct PreparedFolder {
  FolderLock lock;
  FormerRun former;
};

/// Makes the folder of `--out` ready for a new run, and locks it. Creates it if it is not there. If it is there and not
/// empty, it must hold a former run that has ended, and `overwrite` must be set unless that ended before its first
/// step; that run is set aside. Throws InputError otherwise, before anything is changed, and where the folder cannot be
/// read or its files cannot be moved.
[[nodiscard]] PreparedFolder prepare_output(const std::filesystem::path& folder, bool overwrite);

}  // namespace lahar::cases
