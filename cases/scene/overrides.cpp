#include "cases/scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "cases/scene/one_line.h"
#include "cases/scene/value.h"

namespace lahar::scene {
namespace {

/// An override that makes no sense; becomes an InputMistake.
struct BadOverride : std::runtime_error {
  using std::runtime_error::runtime_error;
};

bool bare(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; }

/// Where the TOML string that begins at `i` is over; one that nothing ends is over with its line. Three quotes end one
/// of several lines; up to two more before them are its own.
std::size_t past_string(std::string_view text, std::size_t i) {
  const char quote = text[i];
  const std::string three(3, quote);
  const bool several_lines = text.substr(i).starts_with(three);
  for (i += several_lines ? 3 : 1; i < text.size(); ++i) {
    if (text[i] == '\n' && !several_lines) return i;
    if (text[i] == '\\' && quote == '"')
      ++i;  // the next is no end
    else if (text[i] == quote && !several_lines)
      return i + 1;
    else if (text.substr(i).starts_with(three))
      return std::min(text.find_first_not_of(quote, i), i + 5);
  }
  return text.size();
}

/// The value as TOML in a table of its own, so that it carries its place.
toml::table parse_value(const std::string& value, const std::string& source) {
  if (value.find('\n') != std::string::npos) throw BadOverride("has a line break, expected one TOML value");
  const auto only = [&](auto is) { return !value.empty() && std::all_of(value.begin(), value.end(), is); };
  const bool number = only([](char c) { return std::isdigit(static_cast<unsigned char>(c)) || c == '+' || c == '-'; });
  const bool word = !number && only([](char c) { return bare(c) || c == '+'; });
  const bool path = only([](char c) { return bare(c) || c == '.' || c == '/'; }) &&
                    (std::isalpha(static_cast<unsigned char>(value[0])) || value.find('/') <= 2);  // a/, /a, ./a, ../a
  try {
    return toml::parse("v = " + value, source);
  } catch (const toml::parse_error& e) {
    if (word || path) return toml::parse("v = " + string_text(value), source);
    const bool text = !value.empty() && std::isalpha(static_cast<unsigned char>(value[0]));
    throw BadOverride(fmt::format("\"{}\" is no TOML value: {}{}", value, e.description(),
                                  text ? "; a text of several words needs quotes, as in key='\"two words\"'" : ""));
  }
}

/// The entry of a list whose key "name" this is.
toml::node* named(toml::array& list, const std::string& name) {
  std::vector<std::string> known;
  for (toml::node& entry : list)
    if (const toml::table* table = entry.as_table())
      if (const auto found = (*table)["name"].value<std::string>()) {
        if (*found == name) return &entry;
        known.push_back(*found);
      }
  throw BadOverride(fmt::format("no entry of the list is named \"{}\", expected {}", name,
                                known.empty() ? "an index" : fmt::format("one of {}", fmt::join(known, ", "))));
}

/// The node that a step leads to, null if it is not there yet; refuses to step into what is no container.
toml::node* child_at(toml::node& node, const PathStep& step) {
  if (!step.key.empty()) {
    if (toml::table* table = node.as_table()) return table->get(step.key);
    throw BadOverride(fmt::format("\"{}\" would be inside {}, expected a table", step.key, kind_text(node)));
  }
  toml::array* list = node.as_array();
  const std::string place = step.name.empty() ? fmt::to_string(step.index) : step.name;
  if (!list) throw BadOverride(fmt::format("index [{}] into {}, expected a list", place, kind_text(node)));
  if (!step.name.empty()) return named(*list, step.name);
  if (step.index > list->size())
    throw BadOverride(fmt::format("index [{}] is past the end, expected at most {}", step.index, list->size()));
  return step.index < list->size() ? list->get(step.index) : nullptr;
}

/// Moves the value `v` of `holder` to where the step leads: a copy would forget where it was written.
toml::node* put(toml::node& node, const PathStep& step, toml::table&& holder) {
  return holder.get("v")->visit([&](auto& value) -> toml::node* {
    if (!step.key.empty()) return &node.as_table()->insert_or_assign(step.key, std::move(value)).first->second;
    toml::array& list = *node.as_array();
    if (!step.name.empty()) throw BadOverride(fmt::format("replaces entry [{}], expected a key of it", step.name));
    if (step.index == list.size())
      list.push_back(std::move(value));
    else
      list.replace(list.cbegin() + static_cast<std::ptrdiff_t>(step.index), std::move(value));
    return list.get(step.index);
  });
}

/// Lists of numbers and words are read as a whole: what is wrong in one is told where it was last changed. Lists of
/// tables keep their place, as their tables do.
void move_to(const std::string& source, toml::node& node, const PathStep& step) {
  toml::node* const old = child_at(node, step);
  toml::array* const list = old ? old->as_array() : nullptr;
  if (!list || std::any_of(list->begin(), list->end(), [](const toml::node& n) { return n.is_table(); })) return;
  toml::table whole = toml::parse("v = []", source);
  toml::array& moved = *whole["v"].as_array();
  for (toml::node& entry : *list) entry.visit([&](auto& value) { moved.push_back(std::move(value)); });
  put(node, step, std::move(whole));
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

void apply(toml::table& root, const std::string& text, std::string_view origin) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw BadOverride("has no \"=\", expected key.path=value");
  const std::vector<PathStep> path = parse_path(trimmed(text.substr(0, equals)));
  if (path.empty()) throw BadOverride(fmt::format("\"{}\" is no key path, expected a.b[0].c", text.substr(0, equals)));
  if (path.size() > kMostKeyParts || find_long_key(text) != std::string::npos)
    throw BadOverride(fmt::format("has a key of more than {} parts, expected a.b[0].c", kMostKeyParts));
  const std::string source = fmt::format("{}{}", origin, on_one_line(text));
  toml::table holder = parse_value(trimmed(text.substr(equals + 1)), source);
  for (const char* key : {"base", "changes"}) {  // of scene, which were read before
    const bool whole = path.size() == 1 && holder["v"][key];
    if (path[0].key == "scene" && (whole || (path.size() > 1 && path[1].key == key)))
      throw BadOverride(fmt::format("comes after bases are read, expected scene.{} as a key of a scene file", key));
  }
  toml::node *at = &root, *list_in = &root;
  const PathStep* list_key = &path[0];  // a path begins with a key
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (!path[i].key.empty()) list_in = at, list_key = &path[i];
    toml::node* next = child_at(*at, path[i]);
    if (!next) next = put(*at, path[i], toml::parse(path[i + 1].key.empty() ? "v = []" : "v = {}", source));
    at = next;
  }
  child_at(*at, path.back());  // refuses what is no container, or past its end
  put(*at, path.back(), std::move(holder));
  if (path.back().key.empty()) move_to(source, *list_in, *list_key);
}

}  // namespace

std::size_t find_long_key(std::string_view text) {
  enum class Last { part, dot, other } last = Last::other;  // but for blanks
  std::size_t start = 0;
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = i;
    const char c = text[i++];
    if (c == ' ' || c == '\t') continue;
    if (bare(c) || c == '"' || c == '\'') {
      if (bare(c))
        while (i < text.size() && bare(text[i])) ++i;
      else
        i = past_string(text, begin);
      if (last != Last::dot) dots = 0, start = begin;
      last = Last::part;
    } else if (c == '.' && last == Last::part) {
      if (++dots == kMostKeyParts) return start;
      last = Last::dot;
    } else {
      if (c == '#') i = std::min(text.find('\n', i), text.size());
      last = Last::other;
    }
  }
  return std::string_view::npos;
}

std::vector<PathStep> parse_path(std::string_view text) {
  std::vector<PathStep> path;
  std::size_t i = 0;
  while (i < text.size()) {
    if (text[i] == '[') {
      const std::size_t close = text.find(']', i);
      if (close == std::string_view::npos || close == i + 1 || path.empty()) return {};
      const std::string_view word = text.substr(i + 1, close - i - 1);
      PathStep step;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), step.index);
      if (error != std::errc{} || end != word.data() + word.size()) {
        if (!bare(word.front()) || word.front() == '-' || !std::all_of(word.begin(), word.end(), bare)) return {};
        step.name = word;
      }
      i = close + 1;
      path.push_back(step);
    } else {
      if (!path.empty() && text[i++] != '.') return {};
      const std::size_t start = i;
      while (i < text.size() && bare(text[i])) ++i;
      if (i == start) return {};
      path.push_back({std::string(text.substr(start, i - start))});
    }
  }
  return path;
}

std::vector<InputMistake> apply_overrides(toml::table& root, const std::vector<std::string>& overrides,
                                          std::string_view origin) {
  std::vector<InputMistake> mistakes;
  for (const std::string& text : overrides) {
    try {
      apply(root, text, origin);
    } catch (const BadOverride& e) {
      mistakes.push_back({fmt::format("{}{}", origin, on_one_line(text)), 1, 1, on_one_line(e.what())});
    }
  }
  return mistakes;
}

}  // namespace lahar::scene
