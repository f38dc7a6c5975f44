#pragma once
// Text files line by line, as numbers and words.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "cases/files/mesh_file.h"

namespace lahar::cases {

/// Walks over the lines of a text.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  /// The words of the next line that has any, false at the end.
  bool next(std::vector<std::string_view>& words) {
    for (words.clear(); words.empty() && !rest_.empty(); ++number_) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      split(rest_.substr(0, end), words);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
    }
    return !words.empty();
  }
  /// What has not been read yet.
  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw ShapeFileError(fmt::format("line {}: {}", number_, what));
  }
  /// A finite number.
  [[nodiscard]] double number(std::string_view word) const {
    double value = 0;
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
      fail(fmt::format("\"{}\" is no finite number", word.substr(0, 40)));
    return value;
  }
  [[nodiscard]] long whole(std::string_view word) const {
    long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
      fail(fmt::format("\"{}\" is no whole number", word.substr(0, 40)));
    return value;
  }

 private:
  static void split(std::string_view line, std::vector<std::string_view>& words) {
    constexpr std::string_view blank = " \t\r\f\v";
    for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
      words.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(blank, end);
    }
  }

  std::string_view rest_;
  int number_ = 0;
};

}  // namespace lahar::cases
