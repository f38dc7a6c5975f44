#pragma once
// The visitor that writes a described part back as TOML, every default filled in.
#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/scene/range.h"
#include "cases/scene/schema.h"
#include "cases/scene/value.h"

namespace lahar::scene {

/// Values of a table come before the tables inside it, as TOML demands.
class TomlWriter {
 public:
  explicit TomlWriter(std::string path) : path_(std::move(path)) {}

  template <class T>
  void value(std::string_view key, const T& field, const Rule&, std::string_view) {
    values_ += std::string(key) + " = " + toml_text(field) + "\n";
  }
  template <class T>
  void value(std::string_view key, const std::optional<T>& field, const Rule& rule, std::string_view doc) {
    if (field) value(key, *field, rule, doc);
  }
  template <class T>
  void table(std::string_view key, T& part, Presence, std::string_view) {
    inner_ += write(path_of(key), "[" + path_of(key) + "]\n", part);
  }
  template <class T>
  void array(std::string_view key, std::vector<T>& parts, std::string_view) {
    for (T& part : parts) inner_ += write(path_of(key), "[[" + path_of(key) + "]]\n", part);
  }
  template <class T>
  void named(std::string_view key, std::vector<T>& parts, std::string_view) {
    for (T& part : parts) {
      const std::string path = path_of(key) + "." + key_text(part.name);
      inner_ += write(path, "[" + path + "]\n", part);
    }
  }
  template <class Body>
  void only_with(std::string_view, bool holds, std::string_view, const Body& body) {
    if (holds) body();
  }
  template <class Body>
  void when_on(bool enabled, const Body& body) {
    if (enabled) body();
  }
  [[nodiscard]] std::string text(const std::string& header) const {
    return (values_.empty() ? "" : "\n" + header + values_) + inner_;
  }

 private:
  template <class T>
  static std::string write(const std::string& path, const std::string& header, T& part) {
    TomlWriter inner(path);
    describe(inner, part);
    return inner.text(header);
  }
  static std::string key_text(const std::string& key) {
    for (const char c : key)
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') return string_text(key);
    return key.empty() ? "\"\"" : key;
  }
  [[nodiscard]] std::string path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  }

  std::string path_, values_, inner_;
};

}  // namespace lahar::scene
