#pragma once
// `lahar resume DIR`: goes on with an interrupted, failed or finished run from its last checkpoint, in its folder.
#include <filesystem>
#include <string>
#include <vector>

#include "cases/scene/scene.h"

namespace lahar::cases {

/// What may be set for the rest of a run: none of it changes what happens, only for how long and what is written.
const std::vector<std::string>& resumable_keys();

/// The scene of the run in `folder` with overrides. Throws InputError where there is no run or no checkpoint of it, or
/// an override changes anything but resumable_keys().
scene::Scene load_resumed(const std::filesystem::path& folder, const std::vector<std::string>& overrides);

}  // namespace lahar::cases
