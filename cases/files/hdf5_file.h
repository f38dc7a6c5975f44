#pragma once
// A thin layer over the HDF5 C library: handles that close themselves, errors as exceptions that name the file, and
// the two kinds of dataset that result files need (whole arrays and columns that grow). All datasets are compressed
// (byte shuffle + gzip level 1: half the size of a velocity field at little cost).
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cases/files/output_file.h"
#include "core/archive.h"

namespace lahar::cases {

/// Owns one HDF5 identifier and closes it. (HDF5's own header stays out of ours.)
class Hdf5Handle {
 public:
  using Id = std::int64_t;
  Hdf5Handle() = default;
  explicit Hdf5Handle(Id id) : id_(id) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_) { other.id_ = -1; }
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() { reset(); }
  [[nodiscard]] Id id() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }
  void reset() noexcept;

 private:
  Id id_ = -1;
};

/// A one-dimensional dataset of doubles that grows at its end.
class Hdf5Column {
 public:
  /// Throws FileError if the dataset is no growing column of doubles.
  Hdf5Column(std::filesystem::path path, std::string name, Hdf5Handle dataset);
  /// Adds values at the end. Throws FileError.
  void append(std::span<const double> values);
  /// Drops everything from row `rows` on. Throws FileError.
  void truncate(std::uint64_t rows);
  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::filesystem::path path_;
  std::string name_;
  Hdf5Handle dataset_;
  std::uint64_t rows_ = 0;
};

/// A one-dimensional dataset of fixed length that is written or read part by part. Not compressed: the low bits of
/// populations are noise.
class Hdf5Parts {
 public:
  Hdf5Parts(std::filesystem::path path, std::string name, Hdf5Handle dataset, Archive::Number type,
            std::uint64_t count);
  /// The next `count` numbers. Throw FileError.
  void write(const void* data, std::uint64_t count);
  void read(void* data, std::uint64_t count);
  /// What was written goes to the system: as the list closes nobody hears of what fails.
  void flush();
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  template <class Pass>
  void pass(std::uint64_t count, const std::string& what, const Pass& transfer);
  std::filesystem::path path_;
  std::string name_;
  Hdf5Handle dataset_;
  Archive::Number type_;
  std::uint64_t count_, done_ = 0;
};

/// An HDF5 file. T is one of float, double, std::int32_t, std::int64_t, std::uint8_t, std::uint32_t. Every function
/// throws FileError when the library or the disk refuses.
class Hdf5File {
 public:
  /// Makes a new file; an old one of that name is overwritten. Other programs may read it while it is open.
  static Hdf5File create(const std::filesystem::path& path);
  static Hdf5File open_for_reading(const std::filesystem::path& path);
  /// Opens an existing file to add to it.
  static Hdf5File open_for_appending(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  [[nodiscard]] bool contains(const std::string& name) const;
  /// Names of the members of a group, in alphabetical order.
  [[nodiscard]] std::vector<std::string> members(const std::string& group) const;

  /// Writes a whole array of the given dimensions (their product is values.size(), the last one varies fastest).
  template <class T>
  void write(const std::string& name, std::span<const T> values, const std::vector<std::uint64_t>& dimensions);
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& name) const;
  [[nodiscard]] std::vector<std::uint64_t> dimensions(const std::string& name) const;

  /// A new growing column, stored in chunks of `chunk_rows`.
  [[nodiscard]] Hdf5Column create_column(const std::string& name, std::uint64_t chunk_rows);
  /// Throws FileError if there is none of that name, or something else.
  [[nodiscard]] Hdf5Column open_column(const std::string& name);
  /// Names of the growing columns of a group that have all of these attributes as texts, in alphabetical order; also of
  /// what is damaged so that it cannot be opened. Other members are of other programs.
  [[nodiscard]] std::vector<std::string> columns(const std::string& group, const std::vector<std::string>& texts) const;

  /// Datasets that go in parts.
  [[nodiscard]] Hdf5Parts create_parts(const std::string& name, Archive::Number type, std::uint64_t count);
  /// Throws FileError if the dataset is missing, of another type, or not there in full.
  [[nodiscard]] Hdf5Parts open_parts(const std::string& name, Archive::Number type) const;
  /// Removes a dataset or a group from the names of the file; its space is not given back.
  void remove(const std::string& name);

  /// Attributes of a group or dataset ("/" is the file itself).
  void set_attribute(const std::string& object, const std::string& key, const std::string& text);
  void set_attribute(const std::string& object, const std::string& key, double value);
  /// Throw FileError also where there are several values, and for a text that set_attribute does not write.
  [[nodiscard]] std::string text_attribute(const std::string& object, const std::string& key) const;
  [[nodiscard]] double number_attribute(const std::string& object, const std::string& key) const;

  /// Hands everything to the operating system: what was written so far stays readable if the program is killed.
  void flush();
  /// Flushes and closes. The destructor closes too, but cannot report an error. Columns must be gone by then.
  void close();

 private:
  Hdf5File(std::filesystem::path path, Hdf5Handle file) : path_(std::move(path)), file_(std::move(file)) {}
  std::filesystem::path path_;
  Hdf5Handle file_;
};

}  // namespace lahar::cases
