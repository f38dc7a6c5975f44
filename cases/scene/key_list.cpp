#include "cases/scene/key_list.h"

#include <fmt/format.h>

#include <string_view>

#include "cases/scene/schema.h"
#include "cases/scene/value.h"

namespace lahar::scene {
namespace {

/// The visitor that collects. Inner tables get entries of their own, after the table that holds them.
class Collector {
 public:
  Collector(std::vector<TableEntry>& tables, std::string path) : tables_(tables), path_(std::move(path)) {}

  template <class T>
  void value(std::string_view key, const T& field, const Rule& rule, std::string_view doc) {
    tables_[own_].keys.push_back(
        {.key = std::string(key),
         .type = expected_text(field, {.min_count = rule.min_count, .max_count = rule.max_count}),
         .range = rule.range.text(),
         .default_value = rule.required ? "" : toml_text(field),
         .required = rule.required,
         .condition = std::string(condition_),
         .doc = std::string(doc) + choices_text(field)});
  }
  template <class T>
  void table(std::string_view key, T& part, Presence, std::string_view doc) {
    visit(path_of(key), "[" + path_of(key) + "]", doc, part);
  }
  template <class T>
  void array(std::string_view key, const std::vector<T>&, std::string_view doc) {
    T part;
    visit(path_of(key), "[[" + path_of(key) + "]]", doc, part);
  }
  template <class T>
  void named(std::string_view key, const std::vector<T>&, std::string_view doc) {
    T part;
    const std::string path = path_of(key) + ".NAME";
    visit(path, "[" + path + "]", doc, part);
  }
  template <class Body>
  void only_with(std::string_view, bool, std::string_view condition, const Body& body) {
    condition_ = condition;
    body();
    condition_ = {};
  }
  template <class Body>
  void when_on(bool, const Body& body) {
    body();
  }

 private:
  template <class T>
  void visit(const std::string& path, const std::string& header, std::string_view doc, T& part) {
    Collector inner(tables_, path);
    inner.own_ = tables_.size();
    tables_.push_back({path, header, std::string(doc), {}});
    describe(inner, part);
  }
  [[nodiscard]] std::string path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  }

  std::vector<TableEntry>& tables_;
  std::string path_;
  std::size_t own_ = 0;
  std::string_view condition_;
};

std::string row(const KeyEntry& k) {
  const std::string type = k.range.empty() ? k.type : k.type + "; " + k.range;
  const std::string fallback = k.required ? "required" : k.default_value.empty() ? "none" : "`" + k.default_value + "`";
  const std::string condition = k.condition.empty() ? "" : " Only with `" + k.condition + "`.";
  return fmt::format("| `{}` | {} | {} | {}{} |\n", k.key, type, fallback, k.doc, condition);
}

}  // namespace

const std::vector<TableEntry>& all_keys() {
  static const std::vector<TableEntry> tables = [] {
    std::vector<TableEntry> all;
    Collector collector(all, "");
    Scene scene;
    describe(collector, scene);
    return all;
  }();
  return tables;
}

std::string reference_page() {
  std::string page =
      "# Scene reference\n\n"
      "Every key of a scene file (TOML), as printed by `lahar keys`: this page is generated, do not edit it. SI units; "
      "the "
      "unit is part of the key. `--set key.path=value` changes any of them, e.g. `--set fluid.cell_size_m=0.02` or "
      "`--set "
      "'grains.sphere[0].velocity_m_s=[1, 0, 0]'`. Keys marked \"required\" inside a part that is switched off "
      "(`enabled = false`) may be left out.\n";
  for (const TableEntry& table : all_keys()) {
    page += fmt::format("\n## `{}`\n\n{}\n", table.header, table.doc);
    if (table.keys.empty()) continue;
    page += "\n| key | type and range | default | meaning |\n|---|---|---|---|\n";
    for (const KeyEntry& key : table.keys) page += row(key);
  }
  return page;
}

}  // namespace lahar::scene
