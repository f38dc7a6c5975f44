#pragma once
// The command line that all executables share, and their exit codes.
#include <CLI/CLI.hpp>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/runner/run.h"

namespace lahar::cases {

inline constexpr int exit_done = 0, exit_bug = 1, exit_bad_input = 2, exit_numerical_failure = 3,
                     exit_interrupted = 130;

struct CommonOptions {
  std::vector<std::string> set;  ///< key.path=value
  std::string out;               ///< empty: the program's default
  int threads = 0;               ///< 0: all of the machine
  std::string precision;         ///< empty: as the scene says
  bool quiet = false, overwrite = false;
};

/// Which of the common options a program has a use for. --set, --threads and --quiet belong to every one.
struct Taken {
  std::string out = "Folder for results (default results/NAME)";  ///< what --out is to it; empty: it has none
  bool precision = true, overwrite = true;
};

/// Adds --set, --threads, --quiet and what is taken of --out, --precision and --overwrite: the rest stays unknown.
void add_common_options(CLI::App& app, CommonOptions& options, const Taken& taken = {});

/// Adds --version: name, version and commit.
void add_version(CLI::App& app);

/// The overrides of a command line in order, --precision last.
std::vector<std::string> overrides_of(const CommonOptions& options);

RunOptions run_options(const CommonOptions& options, const scene::Scene& scene);

/// Number of threads, all of the machine for 0.
int threads_or_all(int threads);

/// Year, month and day now, UTC: "2020-02-29".
std::string today();

/// Throws InputError: a mistake of the command line.
[[noreturn]] void refuse_command_line(const std::string& why);

/// Throws InputError where a program is given --set and has nothing to set.
void refuse_changes(const CommonOptions& options, const std::string& why);

/// What `ask` returns; where it throws std::invalid_argument, for a name that is none, a mistake of the command line.
template <class Ask>
auto ask_by_name(const Ask& ask) {
  try {
    return ask();
  } catch (const std::invalid_argument& e) {
    refuse_command_line(e.what());
  }
}

/// Runs a command, prints what it throws to stderr (one line per mistake) and returns the exit code.
int guarded(const std::function<int()>& command);

/// Parses the command line; then calls the command that was chosen. Bad command lines exit with 2, --help with 0.
int parse_and_run(CLI::App& app, int argc, char** argv, const std::function<int()>& command);

}  // namespace lahar::cases
