#include "cases/scene/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include "cases/scene/one_line.h"
#include "cases/scene/overrides.h"
#include "cases/scene/value.h"
#include "cases/scene/writer.h"

namespace lahar::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kChangesMark = "scene.changes: ";

[[noreturn]] void fail(const std::string& file, int line, int column, std::string message) {
  throw InputError(std::vector<InputMistake>{{file, line, column, std::move(message)}});
}

/// How much a file may hold, MiB. A resolved scene spells out what its source leaves to defaults and bases.
std::uintmax_t most_mebibytes(const fs::path& file) {
  std::string start(std::string_view(resolved_mark).size(), '\0');
  std::ifstream(file, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == resolved_mark ? 256 : 16;
}

std::string read_text(const fs::path& file) {
  const std::string name = file.string();
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) fail(name, 0, 0, "there is no such file, expected a scene (TOML)");
  if (fs::is_directory(status)) fail(name, 0, 0, "is a directory, expected a scene file (TOML)");
  if (!fs::is_regular_file(status)) fail(name, 0, 0, "is no ordinary file, expected a scene file (TOML)");
  const std::uintmax_t most = most_mebibytes(file);
  if (fs::file_size(file, error) > most << 20)
    fail(name, 0, 0, fmt::format("is larger than {} MiB, expected a scene file (TOML)", most));
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || (fs::file_size(file, error) > 0 && !(text << in.rdbuf()))) fail(name, 0, 0, "cannot be read");
  return text.str();
}

toml::table parse_file(const fs::path& file) {
  const std::string text = read_text(file);
  if (const std::size_t key = find_long_key(text); key != std::string::npos) {
    const std::size_t line =
        static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(key), '\n')) + 1;
    const std::size_t begin = key == 0 ? 0 : text.rfind('\n', key - 1) + 1;
    fail(file.string(), static_cast<int>(line), static_cast<int>(key - begin + 1),
         fmt::format("a key has more than {} parts, expected a key of a scene", kMostKeyParts));
  }
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& e) {
    const Place at = place_of(e.source());
    fail(file.string(), at.line, at.column, fmt::format("syntax: {}, expected TOML", on_one_line(e.description())));
  }
}

/// Takes from `base` what `top` does not say. Nodes are moved, for a copy would forget where it was written.
void merge(toml::table& top, toml::table&& base) {
  for (auto&& [key, node] : base) {
    toml::node* mine = top.get(key.str());
    if (mine && mine->is_table() && node.is_table()) merge(*mine->as_table(), std::move(*node.as_table()));
    if (mine) continue;
    node.visit([&, &name = key](auto& n) { top.insert_or_assign(name, std::move(n)); });
  }
}

/// Where a change of a base stands, as an origin of apply_overrides.
std::string origin_of(const Place& at) {
  return fmt::format("{}:{}:{}: {}", at.file, at.line, at.column, kChangesMark);
}

/// Applies scene.changes to the file's base, whose lists it names.
void apply_changes(toml::table& root, std::vector<InputMistake>& mistakes) {
  const toml::array* changes = root["scene"]["changes"].as_array();
  if (!changes) return;  // what is no list, or no text in it, is found when the scene is read
  std::vector<std::pair<std::string, Place>> texts;
  for (const toml::node& change : *changes)
    if (const auto text = change.value<std::string>()) texts.emplace_back(*text, place_of(change.source()));
  for (const auto& [text, at] : texts)
    for (const InputMistake& m : apply_overrides(root, {text}, origin_of(at)))
      mistakes.push_back(
          {at.file, at.line, at.column, fmt::format("scene.changes \"{}\" {}", on_one_line(text), m.message)});
}

/// The file with all its bases merged in.
toml::table read_with_bases(const fs::path& file, int depth, std::vector<InputMistake>& mistakes) {
  constexpr int deepest = 8;
  toml::table root = parse_file(file);
  const toml::node_view<toml::node> key = root["scene"]["base"];
  if (!key.is_string()) {
    const toml::array* changes = root["scene"]["changes"].as_array();
    if (changes && !changes->empty() && !key) {
      const Place at = place_of(changes->source());
      mistakes.push_back({at.file, at.line, at.column, "scene.changes without scene.base, expected a scene to change"});
    }
    return root;
  }
  const Place at = place_of(key.node()->source());
  const fs::path next = file.parent_path() / *key.value<std::string>();
  if (depth == deepest)
    fail(at.file, at.line, at.column, fmt::format("scene.base: expected a chain of at most {}", deepest));
  if (std::error_code none; !fs::is_regular_file(next, none))
    fail(at.file, at.line, at.column,
         fmt::format("scene.base is {}, which is no file: expected a scene file", string_text(next.string())));
  toml::table base = read_with_bases(next, depth + 1, mistakes);
  if (toml::table* identity = base["scene"].as_table()) identity->erase("base"), identity->erase("changes");
  merge(root, std::move(base));
  apply_changes(root, mistakes);
  return root;
}

}  // namespace

std::string source_file(const Place& place) {
  if (place.file.starts_with("--set")) return {};
  const std::size_t mark = place.file.find(kChangesMark);
  if (mark == std::string::npos) return place.file;
  std::string file = place.file.substr(0, mark);  // FILE:line:column: , see origin_of
  for (int part = 0; part < 3; ++part) file.resize(std::min(file.size(), file.rfind(':')));
  return file;
}

Place place_of(const toml::source_region& region) {
  Place place;
  if (region.path) place.file = *region.path;
  if (place.file.starts_with(kCommandLine) || place.file.find(kChangesMark) != std::string::npos) return place;
  if (region.begin)
    place.line = static_cast<int>(region.begin.line), place.column = static_cast<int>(region.begin.column);
  return place;
}

toml::table read_document(const fs::path& file, const std::vector<std::string>& overrides,
                          std::vector<InputMistake>& mistakes) {
  toml::table root = read_with_bases(file, 0, mistakes);
  for (InputMistake& m : apply_overrides(root, overrides)) mistakes.push_back(std::move(m));
  return root;
}

}  // namespace lahar::scene
