#pragma once
// The folder that a run writes into (`--out`). Existing results are never overwritten unasked, and what is not ours is
// never touched.
#include <filesystem>

namespace lahar::cases {

/// Whether a folder holds a run: a scene.resolved.toml that Lahar wrote.
bool holds_run(const std::filesystem::path& folder);

/// Makes the folder ready for a new run. Creates it if it is not there. If it is there and not empty, it must hold a
/// former run and `overwrite` must be set; then the files of that run, known by their names, are removed.
/// Throws InputError otherwise, before anything is changed.
void prepare_output(const std::filesystem::path& folder, bool overwrite);

}  // namespace lahar::cases
