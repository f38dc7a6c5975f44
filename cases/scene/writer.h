#pragma once
// A scene back as TOML, every default filled in.
#include <string>

#include "cases/scene/scene.h"

namespace lahar::scene {

/// The first words of every resolved scene; a results folder is known by them.
inline constexpr const char* resolved_mark = "# Lahar: resolved scene.";

/// TOML that loads as the very same scene. Parts that are off are written as `enabled = false` alone.
std::string to_toml(const Scene& scene);

}  // namespace lahar::scene
