#pragma once
// A checkpoint as an HDF5 file: a dataset per list of numbers, named as its owner names it, with a check sum in the
// attribute `check`. A list is handed to its owner only after its sum was found right.
#include <filesystem>
#include <optional>

#include "cases/files/hdf5_file.h"
#include "core/archive.h"

namespace lahar::cases {

/// FNV-1a, 64 bits: finds damage, not malice.
class CheckSum {
 public:
  void add(const void* data, std::size_t bytes);
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325U;
};

/// Saves into a new file. Throws FileError.
class CheckpointWriter : public Archive {
 public:
  explicit CheckpointWriter(const std::filesystem::path& path);
  [[nodiscard]] Hdf5File& file() { return file_; }

 protected:
  std::size_t begin(const std::string& path, Number type, std::size_t count) override;
  void pass(void* data, std::size_t count) override;
  void end() override;

 private:
  Hdf5File file_;
  std::optional<Hdf5Parts> list_;
  std::string name_;
  Number type_ = Number::u8;
  CheckSum sum_;
};

/// Loads from a file. Throws FileError, and ArchiveError for a list whose check sum is wrong.
class CheckpointReader : public Archive {
 public:
  explicit CheckpointReader(const std::filesystem::path& path);
  [[nodiscard]] const Hdf5File& file() const { return file_; }

 protected:
  std::size_t begin(const std::string& path, Number type, std::size_t count) override;
  void pass(void* data, std::size_t count) override;
  void end() override {}

 private:
  void verify(const std::string& name, Number type) const;

  Hdf5File file_;
  std::optional<Hdf5Parts> list_;
};

}  // namespace lahar::cases
