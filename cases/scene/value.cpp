#include "cases/scene/value.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

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
      out << fmt::format("{:g}", n.get());
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
  std::string text = "\"";
  for (const char c : s) {
    const auto u = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      text += std::string("\\") + c;
    else if (u < 0x20 || u == 0x7f)
      text += fmt::format("\\u{:04X}", u);
    else
      text += c;
  }
  return text + "\"";
}

std::string read(const toml::node& node, const Rule& rule, double& value) {
  if (!node.is_number()) return "is " + kind_text(node);
  const double number = *node.value<double>();
  if (!std::isfinite(number) || !rule.range.contains(number)) return "is " + quote(node);
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

std::string read(const toml::node& node, const Rule& rule, TimeValue& value) {
  const toml::array* list = node.as_array();
  if (!list) return "is " + kind_text(node);
  if (list->size() != 2) return fmt::format("has {} entries", list->size());
  TimeValue pair;
  if (const std::string wrong = read((*list)[0], {}, pair.time); !wrong.empty()) return "has a time, which " + wrong;
  if (const std::string wrong = read((*list)[1], rule, pair.value); !wrong.empty())
    return "has a value, which " + wrong;
  value = pair;
  return {};
}

}  // namespace lahar::scene
