#pragma once
// A scene from start to end.
#include <spdlog/logger.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>

#include "cases/files/output_file.h"
#include "cases/runner/progress.h"
#include "cases/runner/summary.h"
#include "cases/scene/scene.h"

namespace lahar::cases {

struct RunOptions {
  std::filesystem::path out;  ///< folder for results
  int threads = 0;            ///< 0 = all of the machine
  bool quiet = false;
  bool overwrite = false;  ///< replace a former run in `out`
  bool resume = false;     ///< go on from the checkpoint in `out` (resume.h)
};

/// What a run tells while it is under way.
struct RunMonitor {
  Progress& progress;
  spdlog::logger& log;  ///< run.log
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::function<void()> begin = [] {};  ///< called once all is built that may turn out to be impossible
  /// Tells the user and the log.
  void warn(const std::string& text);
  /// Wall time since the start, s.
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
};

struct RunResult {
  /// A solver fills simulated_seconds, metrics, checks, timers and performance (but for the peak memory), and commit
  /// where others had a part in the run; the rest is known without it.
  Summary summary;
  bool interrupted = false;                ///< ended early by a signal, outputs whole
  double earlier_seconds = 0;              ///< wall time before the checkpoint that the run went on from
  std::optional<FileError> no_checkpoint;  ///< why the last checkpoint could not be written
};

/// Builds the solvers of a scene and runs them until its duration is over or interrupted() says so, writing series and
/// outputs into options.out, which exists. A run that goes on loads all of its checkpoint before it changes anything
/// there, scene.resolved.toml first. Throws NumericalFailure when numbers go wrong, at the end at the latest.
RunResult run_scene(const scene::Scene& scene, const RunOptions& options, RunMonitor& monitor);

using Runner = std::function<RunResult(const scene::Scene&, const RunOptions&, RunMonitor&)>;

/// A whole run: locks the folder, prepares it (see prepare_output) and writes scene.resolved.toml unless it is resumed,
/// opens run.log, limits the threads, runs, and writes summary.json. A failure is logged and passed on, with the name
/// of the last checkpoint if there is one; summary.json is then that of an earlier part of the run, or absent. Throws
/// FileError if all but the last checkpoint could be written; summary.json is then that of the run.
RunResult run_to_folder(const scene::Scene& scene, const RunOptions& options, const Runner& runner);

}  // namespace lahar::cases
