#pragma once
// From a file to a scene that is known to make sense.
#include <filesystem>
#include <string>
#include <vector>

#include "cases/scene/scene.h"

namespace lahar::scene {

/// Reads a scene file with its bases, applies the overrides (`key.path[0].key=value`), fills in defaults and checks
/// everything, including what only shows when parts are seen together. Throws InputError with all mistakes, each
/// located.
Scene load(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

}  // namespace lahar::scene
