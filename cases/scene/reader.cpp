#include "cases/scene/reader.h"

#include <algorithm>
#include <cctype>

#include "cases/scene/key_list.h"

namespace lahar::scene {
namespace {

/// What to say about an unknown key: the nearest sibling, or the table where such a key does exist.
std::string suggestion(const std::string& path, const std::string& key, const std::vector<std::string>& siblings) {
  const std::string nearest = nearest_name(key, siblings);
  if (!nearest.empty()) return fmt::format(" (did you mean \"{}\"?)", nearest);
  std::string homes;
  for (const TableEntry& table : all_keys())
    for (const KeyEntry& entry : table.keys)
      if (entry.key == key && table.path != path) homes += (homes.empty() ? "" : " or ") + ("[" + table.path + "]");
  return homes.empty() ? "" : fmt::format(" (it belongs in {})", homes);
}

std::string listing(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& w : words) all += (all.empty() ? "" : ", ") + w;
  return all;
}

}  // namespace

const toml::node* Reader::find(std::string_view key) {
  known_.emplace_back(key);
  const toml::node* node = table_.get(key);
  if (node) findings_.locate(path_of(key), place_of(node->source()));
  return node;
}

std::string Reader::path_of(std::string_view key, std::string_view name) const {
  const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  return fmt::format("{}.{}", path_of(key), bare ? std::string(name) : string_text(std::string(name)));
}

void Reader::missing(std::string_view key, const std::string& expected) {
  mistake(path_of(key), fmt::format("{} is missing, expected {}", path_of(key), expected));
}

void Reader::out_of_place(std::string_view key) {
  mistake(path_of(key), fmt::format("{} does not apply here, expected only with {}", path_of(key), note_));
}

void Reader::wrong_kind(std::string_view key, const toml::node& node, std::string_view expected) {
  mistake(path_of(key), fmt::format("{} is {}, expected {}", path_of(key), kind_text(node), expected));
}

void Reader::refuse_unknown() {
  for (const auto& [name, node] : table_) {
    const std::string key(name.str());
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const Place at = place_of(name.source().path ? name.source() : node.source());
    const std::string hint = suggestion(path_, key, known_);
    const std::string where = path_.empty() ? "at the top level" : fmt::format("in [{}]", path_);
    findings_.mistake_at(
        at, fmt::format("unknown key {} {}{}, expected one of: {}", string_text(key), where, hint, listing(known_)));
  }
}

}  // namespace lahar::scene
