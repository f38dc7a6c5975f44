#pragma once
// Folders and files that results go into. What a run wrote is never overwritten unasked, what is not ours is never
// touched, and a place that nothing can be written to is refused before hours of work.
#include <filesystem>
#include <string>

namespace lahar::cases {

/// Whether a folder holds a run: a scene.resolved.toml that Lahar wrote.
bool holds_run(const std::filesystem::path& folder);

/// Creates the folder that a command-line option names, if it is not there. Throws InputError where it cannot be made
/// or nothing can be written into it, or a file stands there.
void create_folder(const std::filesystem::path& folder, const std::string& option = "--out");

/// Throws InputError unless the file that a command-line option names can be written. What stands there stays as it is.
void require_writable(const std::filesystem::path& file, const std::string& option);

/// Makes the folder of `--out` ready for a new run. Creates it if it is not there. If it is there and not empty, it
/// must hold a former run and `overwrite` must be set; then the files of that run, known by their names, are removed.
/// Throws InputError otherwise, before anything is changed.
void prepare_output(const std::filesystem::path& folder, bool overwrite);

}  // namespace lahar::cases
