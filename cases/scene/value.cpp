#include "cases/scene/value.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <sstream>

#include "cases/scene/one_line.h"

namespace lahar::scene {

std::string kind_text(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

std::string quote(const toml::node& node) {
  constexpr std::size_t longest = 60;
  std::ostringstream out;
  node.visit([&](const auto& n) {
    if constexpr (toml::is_integer<decltype(n)>)
      out << n.get();
    else if constexpr (toml::is_floating_point<decltype(n)>)
      out << number_text(n.get());
    else if constexpr (toml::is_boolean<decltype(n)>)
      out << (n.get() ? "true" : "false");
    else if constexpr (toml::is_string<decltype(n)>)
      out << string_text(n.get().substr(0, longest));
    else
      out << kind_text(node);
  });
  return out.str();
}

std::string number_text(double v) {
  std::string text = fmt::format("{}", v);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string string_text(const std::string& s) {
  std::string text;
  for (const char c : s) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return '"' + on_one_line(text) + '"';
}

bool fits_in_toml(const std::string& s) {
  try {
    (void)toml::parse("v = " + string_text(s));
    return true;
  } catch (const toml::parse_error&) {
    return false;
  }
}

std::string read(const toml::node& node, const Rule& rule, double& value) {
  if (!node.is_number()) return "is " + kind_text(node);
  // Not node.value<double>(), which has none for a whole number beyond 2^53.
  const auto whole = node.value_exact<std::int64_t>();
  const double number = whole ? static_cast<double>(*whole) : *node.value_exact<double>();
  if (!std::isfinite(number) || !rule.range.contains(number)) return "is " + quote(node);
  constexpr double least = 1e-30, most = 1e30;  // beyond, squares and cubes leave what a double holds
  if (number != 0 && (std::abs(number) < least || std::abs(number) > most))
    return "is " + quote(node) + ", which makes sense in no unit";
  value = number;
  return {};
}

std::string read(const toml::node& node, const Rule& rule, std::int64_t& value) {
  const auto number = node.value_exact<std::int64_t>();
  if (!number) return "is " + (node.is_floating_point() ? quote(node) : kind_text(node));
  if (!rule.range.contains(static_cast<double>(*number))) return "is " + quote(node);
  value = *number;
  return {};
}

std::string read(const toml::node& node, const Rule&, bool& value) {
  const auto flag = node.value_exact<bool>();
  if (!flag) return "is " + quote(node);
  value = *flag;
  return {};
}

std::string read(const toml::node& node, const Rule&, std::string& value) {
  const auto text = node.value_exact<std::string>();
  if (!text) return "is " + kind_text(node);
  value = *text;
  return {};
}

std::string read(const toml::node& node, const Rule& rule, Vec3& value) {
  const toml::array* list = node.as_array();
  if (!list) return "is " + kind_text(node);
  if (list->size() != 3) return fmt::format("has {} entries", list->size());
  Vec3 vector;
  for (int k = 0; k < 3; ++k)
    if (const std::string wrong = read((*list)[static_cast<std::size_t>(k)], rule, vector[k]); !wrong.empty())
      return fmt::format("has entry {}, which {}", k + 1, wrong);
  value = vector;
  return {};
}

namespace {

/// Two numbers, each with its name in messages.
std::string read_pair(const toml::node& node, const Rule& rule, const std::array<const char*, 2>& names,
                      std::array<double, 2>& pair) {
  const toml::array* list = node.as_array();
  if (!list) return "is " + kind_text(node);
  if (list->size() != 2) return fmt::format("has {} entries", list->size());
  for (std::size_t k = 0; k < 2; ++k)
    if (const std::string wrong = read((*list)[k], k == 0 ? Rule{} : rule, pair[k]); !wrong.empty())
      return fmt::format("has {}, which {}", names[k], wrong);
  return {};
}

}  // namespace

std::string read(const toml::node& node, const Rule& rule, TimeValue& value) {
  std::array<double, 2> pair{};
  const std::string wrong = read_pair(node, rule, {"a time", "a value"}, pair);
  if (wrong.empty()) value = {pair[0], pair[1]};
  return wrong;
}

std::string read(const toml::node& node, const Rule& rule, SievePoint& value) {
  std::array<double, 2> pair{};
  const std::string wrong = read_pair(node, rule, {"an opening", "a percentage"}, pair);
  if (wrong.empty()) value = {pair[0], pair[1]};
  return wrong;
}

}  // namespace lahar::scene
