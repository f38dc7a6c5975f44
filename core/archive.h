#pragma once
// What carries the state of a run to a checkpoint and back. Every owner of state has one function, transfer(Archive&),
// that names its numbers once for both directions; a new number is one line there. Owners know no file format: an
// archive is a file (cases/files/checkpoint_file.h) or memory (core/memory_archive.h).
//
// What follows from the scene (walls, materials, options) is built from the scene again; what follows from the state
// (lists of interface cells, who neighbours whom) is made again by the owner after loading.
#include <algorithm>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/vector.h"

namespace lahar {

/// A stored state that does not fit what it is loaded into: damaged, or of another version or scene.
class ArchiveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Archive {
 public:
  enum class Direction { save, load };
  enum class Number : std::uint8_t { u8, i32, u32, i64, u64, f32, f64 };

  static constexpr std::size_t bytes_of(Number type) {
    return type == Number::u8 ? 1 : type == Number::i32 || type == Number::u32 || type == Number::f32 ? 4 : 8;
  }

  explicit Archive(Direction direction) : direction_(direction) {}
  virtual ~Archive() = default;
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  [[nodiscard]] bool loading() const { return direction_ == Direction::load; }

  /// The state of a part, under its own name.
  template <class Owner>
  void part(std::string_view name, Owner& owner) {
    const Group group(*this, name);
    owner.transfer(*this);
  }

  /// One number, truth value, enumerator or vector.
  template <class T>
  void value(std::string_view name, T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      auto byte = static_cast<std::uint8_t>(x);
      value(name, byte);
      x = byte != 0;
    } else if constexpr (std::is_same_v<T, Vec3>) {
      fixed(name, x.data(), 3);
    } else {
      fixed(name, &x, 1);
    }
  }

  /// As many numbers as there are; on loading the list gets the stored length.
  template <class T>
  void list(std::string_view name, std::vector<T>& values) {
    const std::string path = path_of(name);
    values.resize(begin(path, number_of<T>(), values.size()));
    if (!values.empty()) pass(values.data(), values.size());
    end();
  }
  void list(std::string_view name, std::vector<Vec3>& values);
  void list(std::string_view name, Vec3Field& field);
  void text(std::string_view name, std::string& text);
  void numbers(std::string_view name, std::map<std::string, double>& values);

  /// Lists the same numbers as `list`, and refuses another length than `size`.
  template <class T>
  void list_of(std::string_view name, std::vector<T>& values, std::size_t size) {
    list(name, values);
    if (loading() && values.size() != size)
      refuse(name, "has " + std::to_string(values.size()) + " numbers, not " + std::to_string(size));
  }

  /// `count` pieces of `size` numbers each that do not lie in one list: visit(k, T buffer[size]) fills the buffer when
  /// saving and takes from it when loading. Needs little memory beside the owner's.
  template <class T, class Visit>
  void pieces(std::string_view name, std::size_t count, std::size_t size, const Visit& visit) {
    const std::string path = path_of(name);
    expect(path, begin(path, number_of<T>(), count * size), count * size);
    const std::size_t at_once = std::max<std::size_t>(1, kBufferBytes / (sizeof(T) * size));
    std::vector<T> buffer(std::min(count, at_once) * size);
    for (std::size_t first = 0; first < count; first += at_once) {
      const std::size_t last = std::min(count, first + at_once);
      if (loading()) pass(buffer.data(), (last - first) * size);
      for (std::size_t k = first; k < last; ++k) visit(k, buffer.data() + (k - first) * size);
      if (!loading()) pass(buffer.data(), (last - first) * size);
    }
    end();
  }

  /// Throws ArchiveError about a name of the present part.
  [[noreturn]] void refuse(std::string_view name, const std::string& why) const {
    throw ArchiveError(path_of(name) + " " + why);
  }

 protected:
  /// Begins a list of numbers called `path` ("a/b/c"); returns its length: `count` when saving.
  virtual std::size_t begin(const std::string& path, Number type, std::size_t count) = 0;
  /// The next `count` numbers of the list, from or to `data`.
  virtual void pass(void* data, std::size_t count) = 0;
  virtual void end() = 0;

 private:
  static constexpr std::size_t kBufferBytes = std::size_t{4} << 20;

  /// Enters a part while it lives.
  class Group {
   public:
    Group(Archive& archive, std::string_view name) : archive_(archive), length_(archive.prefix_.size()) {
      archive.prefix_ += std::string(name) + "/";
    }
    ~Group() { archive_.prefix_.resize(length_); }
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;

   private:
    Archive& archive_;
    std::size_t length_;
  };

  template <class T>
  static constexpr Number number_of() {
    if constexpr (std::is_enum_v<T>)
      return number_of<std::underlying_type_t<T>>();
    else if constexpr (std::is_same_v<T, float>)
      return Number::f32;
    else if constexpr (std::is_same_v<T, double>)
      return Number::f64;
    else if constexpr (std::is_integral_v<T> && sizeof(T) == 1)
      return Number::u8;
    else if constexpr (std::is_integral_v<T> && sizeof(T) == 4)
      return std::is_signed_v<T> ? Number::i32 : Number::u32;
    else if constexpr (std::is_integral_v<T> && sizeof(T) == 8)
      return std::is_signed_v<T> ? Number::i64 : Number::u64;
    else
      static_assert(!sizeof(T), "no number that an archive knows");
  }

  template <class T>
  void fixed(std::string_view name, T* data, std::size_t count) {
    const std::string path = path_of(name);
    expect(path, begin(path, number_of<T>(), count), count);
    pass(data, count);
    end();
  }
  static void expect(const std::string& path, std::size_t found, std::size_t expected) {
    if (found != expected)
      throw ArchiveError(path + " has " + std::to_string(found) + " numbers, not " + std::to_string(expected));
  }
  [[nodiscard]] std::string path_of(std::string_view name) const { return prefix_ + std::string(name); }

  Direction direction_;
  std::string prefix_;
};

inline void Archive::list(std::string_view name, Vec3Field& field) {
  const Group group(*this, name);
  list("x", field.x);
  list_of("y", field.y, field.x.size());
  list_of("z", field.z, field.x.size());
}

inline void Archive::list(std::string_view name, std::vector<Vec3>& values) {
  std::vector<double> flat(3 * values.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    for (std::size_t a = 0; a < 3; ++a) flat[3 * k + a] = values[k][static_cast<Eigen::Index>(a)];
  list(name, flat);
  values.resize(flat.size() / 3);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = Vec3(flat[3 * k], flat[3 * k + 1], flat[3 * k + 2]);
}

inline void Archive::text(std::string_view name, std::string& text) {
  std::vector<std::uint8_t> bytes(text.begin(), text.end());
  list(name, bytes);
  text.assign(bytes.begin(), bytes.end());
}

inline void Archive::numbers(std::string_view name, std::map<std::string, double>& values) {
  const Group group(*this, name);
  std::string names;
  std::vector<double> all;
  for (const auto& [key, x] : values) {
    names += key + "\n";
    all.push_back(x);
  }
  text("names", names);
  list("values", all);
  values.clear();
  for (std::size_t from = 0, k = 0; k < all.size(); ++k) {
    const std::size_t to = names.find('\n', from);
    if (to == std::string::npos) refuse("names", "do not fit the values");
    values[names.substr(from, to - from)] = all[k];
    from = to + 1;
  }
}

}  // namespace lahar
