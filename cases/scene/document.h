#pragma once
// The TOML behind a scene: a file, the base files that it builds on, and the user's overrides, merged into one table
// whose values still know where they were written.
#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/check.h"

namespace lahar::scene {

/// Where something is written. Overrides are their own file, `--set key=value`, at 1:1.
struct Place {
  std::string file;
  int line = 1, column = 1;
  auto operator<=>(const Place&) const = default;
};

Place place_of(const toml::source_region& region);

/// The file that a value was written in, also where a change of a base (scene.changes) says it; empty for the command
/// line.
std::string source_file(const Place& place);

/// Reads `file`, its bases (`scene.base`) and the overrides `key.path[0].key=value`. Values of overrides are TOML; a
/// bare word or path stands for a string. Overrides that make no sense are added to `mistakes`. Throws InputError when
/// a file cannot be read or is not TOML.
toml::table read_document(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                          std::vector<InputMistake>& mistakes);

}  // namespace lahar::scene
