#pragma once
// The command line that all executables share, and their exit codes.
#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

#include "cases/runner/run.h"

namespace lahar::cases {

inline constexpr int exit_done = 0, exit_bug = 1, exit_bad_input = 2, exit_numerical_failure = 3,
                     exit_interrupted = 130;

struct CommonOptions {
  std::vector<std::string> set;  ///< key.path=value
  std::string out;               ///< empty: results/NAME
  int threads = 0;
  std::string precision;  ///< empty: as the scene says
  bool quiet = false, overwrite = false;
};

/// Adds --set, --out, --threads, --precision, --quiet and --overwrite.
void add_common_options(CLI::App& app, CommonOptions& options);

/// The overrides of a command line in order, --precision last.
std::vector<std::string> overrides_of(const CommonOptions& options);

RunOptions run_options(const CommonOptions& options, const scene::Scene& scene);

/// Runs a command, prints what it throws to stderr (one line per mistake) and returns the exit code.
int guarded(const std::function<int()>& command);

/// Parses the command line; then calls the command that was chosen. Bad command lines exit with 2, --help with 0.
int parse_and_run(CLI::App& app, int argc, char** argv, const std::function<int()>& command);

}  // namespace lahar::cases
