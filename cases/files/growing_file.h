#pragma once
// A result file that grows during a run and can be read at any time, whenever the run is killed. HDF5 changes a file in
// place, and a program that is killed meanwhile leaves one that nobody can read: so the file grows under another name,
// and copies of it replace the one that others see in single strokes.
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

#include "cases/files/output_file.h"

namespace lahar::cases {

/// A file that may be whole, but cannot be gone on with here: there is no room for its copy, or no right to read it.
class CannotTakeUp : public FileError {
  using FileError::FileError;
};

/// What others see cannot be brought up to date, for want of room; what has grown is whole.
class CannotCopy : public FileError {
  using FileError::FileError;
};

class GrowingFile {
 public:
  /// NAME is what others see.
  explicit GrowingFile(std::filesystem::path name) : name_(std::move(name)) {}

  [[nodiscard]] const std::filesystem::path& name() const { return name_; }
  /// NAME.open, which grows.
  [[nodiscard]] std::filesystem::path open_name() const;
  /// Starts from the file that others see. Throws FileError where there is none, CannotTakeUp where it cannot be
  /// copied.
  void take_up() const;
  /// Whether a copy is due: one a second, or as seldom as they take a fiftieth of the time; a minute after one that
  /// could not be made.
  [[nodiscard]] bool copy_due() const { return Clock::now() >= next_copy_; }
  /// Replaces what others see by a copy of what has grown, which must be flushed. Throws CannotCopy.
  void copy();
  /// Calls `flush`, which ends with copy(), where a copy is due; one that cannot be made is put off.
  void copy_if_due(const std::function<void()>& flush);
  /// Why the last copy that was due could not be made; empty if it could.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }
  /// Replaces it by what has grown itself, which must be closed. Throws FileError.
  void finish() const;
  /// Gives a file that others see and nobody can read another name, NAME.damaged.EXTENSION, or NAME.damaged2.EXTENSION
  /// and so on where there is one, which is returned; empty if there is no such file. Throws FileError.
  [[nodiscard]] std::filesystem::path set_aside() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path name_;
  Clock::time_point next_copy_ = Clock::time_point::min();
  std::string refusal_;
};

}  // namespace lahar::cases
