#include "cases/scene/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include "cases/scene/overrides.h"
#include "cases/scene/value.h"

namespace lahar::scene {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& file, int line, int column, std::string message) {
  throw InputError(std::vector<InputMistake>{{file, line, column, std::move(message)}});
}

std::string read_text(const fs::path& file) {
  const std::string name = file.string();
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) fail(name, 0, 0, "there is no such file, expected a scene (TOML)");
  if (fs::is_directory(status)) fail(name, 0, 0, "is a directory, expected a scene file (TOML)");
  if (!fs::is_regular_file(status)) fail(name, 0, 0, "is no ordinary file, expected a scene file (TOML)");
  constexpr std::uintmax_t most = 16U << 20;
  if (fs::file_size(file, error) > most) fail(name, 0, 0, "is larger than 16 MiB, expected a scene file (TOML)");
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
    fail(file.string(), at.line, at.column, fmt::format("syntax: {}, expected TOML", e.description()));
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

/// The file with all its bases merged in.
toml::table read_with_bases(const fs::path& file, int depth) {
  constexpr int deepest = 8;
  toml::table root = parse_file(file);
  const toml::node_view<toml::node> key = root["scene"]["base"];
  if (!key.is_string()) return root;
  const Place at = place_of(key.node()->source());
  const fs::path next = file.parent_path() / *key.value<std::string>();
  if (depth == deepest)
    fail(at.file, at.line, at.column, fmt::format("scene.base: expected a chain of at most {}", deepest));
  if (!fs::is_regular_file(next))
    fail(at.file, at.line, at.column, fmt::format("scene.base is \"{}\", expected a scene file", next.string()));
  toml::table base = read_with_bases(next, depth + 1);
  if (toml::table* identity = base["scene"].as_table()) identity->erase("base");
  merge(root, std::move(base));
  return root;
}

}  // namespace

Place place_of(const toml::source_region& region) {
  Place place;
  if (region.path) place.file = *region.path;
  if (place.file.starts_with("--set ")) return place;
  if (region.begin)
    place.line = static_cast<int>(region.begin.line), place.column = static_cast<int>(region.begin.column);
  return place;
}

toml::table read_document(const fs::path& file, const std::vector<std::string>& overrides,
                          std::vector<InputMistake>& mistakes) {
  toml::table root = read_with_bases(file, 0);
  for (InputMistake& m : apply_overrides(root, overrides)) mistakes.push_back(std::move(m));
  return root;
}

}  // namespace lahar::scene
