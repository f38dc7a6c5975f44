#pragma once
// The types that a parameter can have: reading from TOML, writing as TOML, and their names in messages.
#include <toml++/toml.h>

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "cases/scene/names.h"
#include "cases/scene/range.h"

namespace lahar::scene {

/// The node's kind in plain words: "a string", "a table".
std::string kind_text(const toml::node& node);
/// A short quotation of the node: `-1`, `"steel"`, `[0, 1]`.
std::string quote(const toml::node& node);
/// Shortest text that reads back as the same number, always with a point or an exponent.
std::string number_text(double v);
/// A TOML basic string.
std::string string_text(const std::string& s);
/// Whether string_text(s) is TOML: not where s is no UTF-8, as the name of a folder may be.
bool fits_in_toml(const std::string& s);

/// Each reads `node` into `value`; returns what is wrong ("is ...", "has ...") or "" if all is well.
std::string read(const toml::node& node, const Rule& rule, double& value);
std::string read(const toml::node& node, const Rule& rule, std::int64_t& value);
std::string read(const toml::node& node, const Rule& rule, bool& value);
std::string read(const toml::node& node, const Rule& rule, std::string& value);
std::string read(const toml::node& node, const Rule& rule, Vec3& value);
std::string read(const toml::node& node, const Rule& rule, TimeValue& value);
std::string read(const toml::node& node, const Rule& rule, SievePoint& value);

inline std::string type_text(double) { return "a number"; }
inline std::string type_text(std::int64_t) { return "a whole number"; }
inline std::string type_text(bool) { return "true or false"; }
inline std::string type_text(const std::string&) { return "a string"; }
inline std::string type_text(const TimeValue&) { return "a pair [time, value]"; }
inline std::string type_text(const SievePoint&) { return "a pair [opening in m, percent passing]"; }
inline std::string type_text(const Vec3&) { return "three numbers [x, y, z]"; }
template <Option E>
std::string type_text(E) {
  std::string all;
  for (const auto& choice : choices(E{})) all += (all.empty() ? "one of \"" : ", \"") + std::string(choice.word) + "\"";
  return all;
}
template <class T>
std::string type_text(const std::optional<T>&) {
  return type_text(T{});
}
template <class T>
std::string type_text(const std::vector<T>&) {
  return "a list, each " + type_text(T{});
}

/// What the values of an option mean: " `word`: meaning; `word`: meaning."; "" for anything else.
template <class T>
std::string choices_text(const T&) {
  std::string all;
  if constexpr (Option<T>)
    for (const auto& choice : choices(T{}))
      if (!choice.meaning.empty())
        all += (all.empty() ? " `" : "; `") + std::string(choice.word) + "`: " + std::string(choice.meaning);
  return all.empty() ? all : all + ".";
}

/// What a key demands, in words: "three numbers [x, y, z], each above 0".
template <class T>
std::string expected_text(const T& value, const Rule& rule) {
  std::string text = type_text(value);
  if (!rule.range.unlimited()) text += (std::is_same_v<T, Vec3> ? ", each " : " ") + rule.range.text();
  const bool bounded = rule.max_count != std::numeric_limits<int>::max();
  if (bounded && rule.min_count == rule.max_count) text += ", " + std::to_string(rule.min_count) + " of them";
  if (bounded && rule.min_count != rule.max_count)
    text += ", " + std::to_string(rule.min_count) + " to " + std::to_string(rule.max_count) + " of them";
  if (!bounded && rule.min_count > 0) text += ", at least " + std::to_string(rule.min_count) + " of them";
  return text;
}

template <Option E>
std::string read(const toml::node& node, const Rule&, E& value) {
  const auto word = node.value_exact<std::string>();
  if (!word) return "is " + kind_text(node);
  for (const auto& choice : choices(E{}))
    if (choice.word == *word) return value = choice.value, std::string{};
  const std::string nearest = nearest_name(*word, words<E>());
  return "is " + quote(node) + (nearest.empty() ? "" : " (did you mean \"" + nearest + "\"?)");
}

template <class T>
std::string read(const toml::node& node, const Rule& rule, std::optional<T>& value) {
  return read(node, rule, value.emplace());
}

template <class T>
std::string read(const toml::node& node, const Rule& rule, std::vector<T>& value) {
  const toml::array* list = node.as_array();
  if (!list) return "is " + kind_text(node);
  const auto count = static_cast<int>(list->size());
  if (count < rule.min_count || count > rule.max_count) return "has " + std::to_string(count) + " entries";
  value.clear();
  for (const toml::node& entry : *list) {
    T item{};
    if (const std::string wrong = read(entry, rule, item); !wrong.empty())
      return "has entry " + std::to_string(value.size() + 1) + ", which " + wrong;
    value.push_back(item);
  }
  return {};
}

inline std::string toml_text(double v) { return number_text(v); }
inline std::string toml_text(std::int64_t v) { return std::to_string(v); }
inline std::string toml_text(bool v) { return v ? "true" : "false"; }
inline std::string toml_text(const std::string& v) { return string_text(v); }
inline std::string toml_text(const Vec3& v) {
  return "[" + number_text(v.x()) + ", " + number_text(v.y()) + ", " + number_text(v.z()) + "]";
}
inline std::string toml_text(const TimeValue& v) {
  return "[" + number_text(v.time) + ", " + number_text(v.value) + "]";
}
inline std::string toml_text(const SievePoint& v) {
  return "[" + number_text(v.opening) + ", " + number_text(v.passing) + "]";
}
template <Option E>
std::string toml_text(E v) {
  return string_text(name_of(v));
}
template <class T>
std::string toml_text(const std::optional<T>& v) {
  return v ? toml_text(*v) : "";
}
template <class T>
std::string toml_text(const std::vector<T>& list) {
  std::string all;
  for (const T& v : list) all += (all.empty() ? "" : ", ") + toml_text(v);
  return "[" + all + "]";
}

}  // namespace lahar::scene
