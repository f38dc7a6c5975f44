#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>

#include "cases/files/output_file.h"
#include "cases/runner/check.h"
#include "cases/runner/checkpoint.h"
#include "cases/runner/machine.h"
#include "cases/runner/options.h"
#include "cases/runner/output_folder.h"
#include "cases/runner/run.h"
#include "cases/scene/names.h"
#include "cases/scene/writer.h"
#include "core/check.h"
#include "core/parallel.h"

namespace lahar::cases {
namespace {

/// Not registered by name: two runs in one process must not share a log.
spdlog::logger open_log(const std::filesystem::path& folder, bool append) {
  spdlog::logger log("run",
                     std::make_shared<spdlog::sinks::basic_file_sink_mt>((folder / "run.log").string(), !append));
  log.set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
  log.flush_on(spdlog::level::info);
  return log;
}

/// What is known of a run whatever its solver.
void complete(Summary& summary, const scene::Scene& scene, int threads, double wall_seconds) {
  summary.case_name = scene.identity.name;
  summary.version = version();
  if (summary.commit.empty()) summary.commit = commit();
  summary.machine = machine_name();
  summary.threads = threads;
  summary.precision = scene::name_of(scene.run.precision);
  summary.wall_seconds = wall_seconds;
  summary.performance.peak_rss_bytes = std::max(summary.performance.peak_rss_bytes, peak_rss_bytes());
}

/// The failure, and from where the run can go on.
NumericalFailure with_checkpoint(const NumericalFailure& e, const std::filesystem::path& folder) {
  const auto last = last_checkpoint(folder);
  if (!last) return e;
  return {e.where(), e.step(),
          e.cause() + fmt::format("; the last good checkpoint is {} of t = {:.6g} s",
                                  (folder / kCheckpointFile).string(), *last)};
}

}  // namespace

RunResult run_to_folder(const scene::Scene& scene, const RunOptions& options, const Runner& runner) {
  const auto start = std::chrono::steady_clock::now();
  const int threads = threads_or_all(options.threads);
  const CheckReport report = check_scene(scene, threads);
  PreparedFolder folder =
      options.resume ? PreparedFolder{FolderLock(options.out), {}} : prepare_output(options.out, options.overwrite);
  if (options.resume) FormerRun::recover(options.out);
  if (!options.resume) replace_text_file(options.out / "scene.resolved.toml", scene::to_toml(scene));
  spdlog::logger log = open_log(options.out, options.resume);
  log.info("Lahar {} ({}), {}, {} threads used", version(), commit(), machine_name(), threads);
  for (const std::string& w : report.warnings) log.warn("{}", w);
  const ThreadLimit limit(threads);
  Progress progress(scene.run.duration, progress_style(options.quiet, stdout));
  RunMonitor monitor{progress, log, start, [&] {
                       folder.former.remove();
                       std::filesystem::remove(options.out / "summary.json");  // of the stretch until now
                       log.info(kStepsBeginMark);
                     }};
  try {
    RunResult result = runner(scene, options, monitor);
    progress.finish();
    complete(result.summary, scene, threads, result.earlier_seconds + monitor.seconds());
    write_summary(options.out, result.summary);
    log.info("{} at t = {:.6g} s", result.interrupted ? "interrupted" : "done", result.summary.simulated_seconds);
    if (result.no_checkpoint) throw FileError(*result.no_checkpoint);
    return result;
  } catch (const NumericalFailure& e) {
    const NumericalFailure told = with_checkpoint(e, options.out);
    log.error("{}", told.what());
    throw told;
  } catch (const std::exception& e) {
    log.error("{}", e.what());
    throw;
  }
}

}  // namespace lahar::cases
