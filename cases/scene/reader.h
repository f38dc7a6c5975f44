#pragma once
// The visitor that fills a part of the scene from TOML and reports everything that does not fit its description.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "cases/scene/findings.h"
#include "cases/scene/schema.h"
#include "cases/scene/value.h"

namespace lahar::scene {

class Reader {
 public:
  Reader(const toml::table& table, std::string path, Findings& findings)
      : table_(table), path_(std::move(path)), findings_(findings) {}

  template <class T>
  void value(std::string_view key, T& field, const Rule& rule, std::string_view) {
    const toml::node* node = find(key);
    if (!node) {
      if (rule.required && demand_ == Demand::full) missing(key, expected_text(field, rule));
      return;
    }
    if (demand_ == Demand::out_of_place) return out_of_place(key);
    const std::string wrong = read(*node, rule, field);
    if (!wrong.empty())
      mistake(path_of(key), fmt::format("{} {}, expected {}", path_of(key), wrong, expected_text(field, rule)));
  }

  template <class T>
  void table(std::string_view key, T& part, Presence presence, std::string_view) {
    static const toml::table nothing;
    const toml::node* node = find(key);
    if (!node && presence == Presence::optional) return;
    if (node && !node->is_table()) return wrong_kind(key, *node, "a table");
    read_part(node ? *node->as_table() : nothing, path_of(key), part);
  }

  template <class T>
  void array(std::string_view key, std::vector<T>& parts, std::string_view) {
    const toml::node* node = find(key);
    if (!node) return;
    if (!node->is_array()) return wrong_kind(key, *node, "a list of tables");
    parts.clear();
    for (const toml::node& entry : *node->as_array()) {
      const std::string path = fmt::format("{}[{}]", path_of(key), parts.size());
      findings_.locate(path, place_of(entry.source()));
      T& part = parts.emplace_back();
      if (!entry.is_table()) {
        mistake(path, fmt::format("{} is {}, expected a table", path, kind_text(entry)));
        continue;
      }
      read_part(*entry.as_table(), path, part);
    }
  }

  template <class T>
  void named(std::string_view key, std::vector<T>& parts, std::string_view) {
    const toml::node* node = find(key);
    if (!node) return;
    if (!node->is_table()) return wrong_kind(key, *node, "a table of named tables");
    parts.clear();
    for (const auto& [name, entry] : *node->as_table()) {
      const std::string path = path_of(key, name.str());
      findings_.locate(path, place_of(name.source().path ? name.source() : entry.source()));
      T& part = parts.emplace_back();
      part.name = name.str();
      if (entry.is_table())
        read_part(*entry.as_table(), path, part);
      else
        mistake(path, fmt::format("{} is {}, expected a table", path, kind_text(entry)));
    }
  }

  template <class Body>
  void only_with(std::string_view key, bool holds, std::string_view note, const Body& body) {
    // With an unknown value of the option nobody can tell which keys belong here.
    const Demand before = demand_;
    if (!findings_.sound({path_of(key)}))
      demand_ = Demand::none;
    else if (!holds)
      demand_ = Demand::out_of_place;
    note_ = note;
    body();
    note_ = {};
    demand_ = before;
  }

  template <class Body>
  void when_on(bool enabled, const Body& body) {
    const Demand before = demand_;
    if (!enabled) demand_ = Demand::none;
    body();
    demand_ = before;
  }

  /// To be called when the description is through: what was not asked for is unknown.
  void refuse_unknown();

 private:
  enum class Demand { full, none, out_of_place };

  template <class T>
  void read_part(const toml::table& from, const std::string& path, T& part) {
    Reader inner(from, path, findings_);
    inner.demand_ = demand_;
    describe(inner, part);
    inner.refuse_unknown();
  }

  /// The node of a key, which is from now on known and located.
  const toml::node* find(std::string_view key);
  void mistake(const std::string& path, std::string message) { findings_.mistake(path, std::move(message)); }
  void missing(std::string_view key, const std::string& expected);
  void out_of_place(std::string_view key);
  void wrong_kind(std::string_view key, const toml::node& node, std::string_view expected);
  [[nodiscard]] std::string path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  }
  /// Of a named table; in quotes where its name needs them.
  [[nodiscard]] std::string path_of(std::string_view key, std::string_view name) const;

  const toml::table& table_;
  std::string path_;
  Findings& findings_;
  std::vector<std::string> known_;
  Demand demand_ = Demand::full;
  std::string_view note_;
};

}  // namespace lahar::scene
