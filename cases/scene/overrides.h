#pragma once
// `--set key.path[0].key=value`: changes to a scene from the command line, or by scene.changes to one that it is based
// on.
#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/check.h"

namespace lahar::scene {

/// One step of a path: a key; or, when that is empty, the name of an entry of a list (its key "name") or its index.
struct PathStep {
  std::string key;
  std::size_t index = 0;
  std::string name = {};
};

/// Parts of a dotted key. Each is a table in a table: a hundred thousand of them are more than a stack takes.
inline constexpr int kMostKeyParts = 64;
/// Where a key of more parts begins in a TOML text, npos if there is none. A part is a word or a string in quotes; dots
/// in strings and comments are none of a key.
std::size_t find_long_key(std::string_view text);

/// Splits `wall[0].slip` and `wall[bed].slip`. Returns an empty list if the text is no path.
std::vector<PathStep> parse_path(std::string_view text);

/// Where the overrides of the command line stand.
inline constexpr std::string_view kCommandLine = "--set ";

/// Applies all overrides in order. An index one past the end appends. Returns a mistake for every override that makes
/// no sense, located as `--set TEXT:1:1`, with another `origin` in place of `--set `.
std::vector<InputMistake> apply_overrides(toml::table& root, const std::vector<std::string>& overrides,
                                          std::string_view origin = kCommandLine);

}  // namespace lahar::scene
