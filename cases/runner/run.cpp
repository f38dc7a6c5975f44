#include "cases/runner/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>

#include "cases/assembly/build.h"
#include "cases/assembly/check_start.h"
#include "cases/assembly/packings.h"
#include "cases/assembly/simulation.h"
#include "cases/files/output_file.h"
#include "cases/observers/fluid_cells.h"
#include "cases/observers/grains.h"
#include "cases/observers/observer_list.h"
#include "cases/runner/checkpoint.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/machine.h"
#include "cases/runner/messages.h"
#include "cases/runner/outputs.h"
#include "cases/runner/schedule.h"
#include "cases/scene/one_line.h"
#include "cases/scene/writer.h"
#include "core/check.h"
#include "dem/watchdog.h"

namespace lahar::cases {

namespace {

/// Grains that have left the domain are taken out of the scene; those that fly up may come back. Throws
/// NumericalFailure where one was thrown out: it would not be there when the watchdog looks.
void remove_leavers(const scene::Scene& scene, dem::Solids* solids) {
  if (!solids) return;
  const dem::Particles& p = solids->particles();
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (p.kind[i] != dem::ParticleKind::grain || p.state[i] != dem::ParticleState::free) continue;
    if (!has_left(scene.domain, p, i)) continue;
    check_motion(p, solids->options().watchdog, solids->step_count());
    solids->remove(i);
  }
}

/// The solvers' watchdogs look at intervals of steps: numbers may have gone wrong since. Throws NumericalFailure.
void watch(Simulation& simulation) {
  if (const FluidView* fluid = simulation.fluid()) fluid->watch();
  const dem::Solids* solids = simulation.solids();
  if (!solids) return;
  const dem::WatchdogOptions& limits = solids->options().watchdog;
  check_motion(solids->particles(), limits, solids->step_count());
  check_overlap(solids->particles(), solids->worst_overlap(), limits, solids->step_count());
}

void fill_performance(Simulation& simulation, const ObserverList& observers, Summary& summary) {
  auto timers = simulation.seconds();
  Performance& p = summary.performance;
  if (const FluidView* fluid = simulation.fluid(); fluid && timers["fluid"] > 0)
    p.mlups = fluid->cell_updates() / timers["fluid"] / 1e6;
  if (const dem::Solids* solids = simulation.solids(); solids && timers["solids"] > 0)
    p.dem_particle_steps_per_second =
        static_cast<double>(solids->particles().size()) * static_cast<double>(solids->step_count()) / timers["solids"];
  if (const auto* cells = observers.find<FluidCells>())
    p.wet_cells_max = cells->most_wet_cells(), p.blocks_max = cells->most_blocks();
  summary.timers.insert(timers.begin(), timers.end());
}

/// What the loop itself has to remember.
struct Loop {
  explicit Loop(const scene::Scene& scene)
      : rows(scene.run.series_interval), checkpoints(scene.run.checkpoint_interval) {
    checkpoints.skip_until(0);
  }

  Schedule rows;                     ///< of the series; without an interval every step
  double wall_seconds = 0;           ///< of the run, when the checkpoint was written
  std::uint64_t peak_rss_bytes = 0;  ///< until then
  Schedule checkpoints;

  void transfer(Archive& archive) {
    archive.part("rows", rows);
    archive.value("wall_seconds", wall_seconds);
    archive.value("peak_rss_bytes", peak_rss_bytes);
    archive.part("checkpoints", checkpoints);
  }
};

SeriesWriter open_series(const std::filesystem::path& path, const std::optional<CheckpointHead>& from,
                         RunMonitor& monitor) {
  if (!from) return SeriesWriter(path);
  if (!std::filesystem::exists(path)) {
    monitor.warn(fmt::format("{} is gone: the series begins anew", path.string()));
    return SeriesWriter(path);
  }
  try {
    SeriesWriter series = SeriesWriter::resume(path, from->last_row);
    for (const std::string& name : series.lost())
      monitor.warn(fmt::format("{}: {} cannot be read, its rows begin anew", path.string(), name));
    return series;
  } catch (const CannotTakeUp&) {  // the rows are not lost
    throw;
  } catch (const FileError& e) {
    const std::filesystem::path aside = GrowingFile(path).set_aside();
    monitor.warn(fmt::format("{}: the series begins anew, the former file is now {}", e.what(), aside.string()));
  }
  return SeriesWriter(path);
}

class SceneRun {
 public:
  SceneRun(const scene::Scene& scene, const RunOptions& options, RunMonitor& monitor)
      : scene_(scene), options_(options), monitor_(monitor), loop_(scene) {
    std::optional<CheckpointHead> from;
    if (options.resume) from = read_head(options.out, scene);
    {
      const ScopedTimer timer(timers_.section("preparation"));
      simulation_ = build_simulation(scene, options.resume ? Beginning::checkpoint : Beginning::scene);
    }
    observers_.emplace(scene, *simulation_);
    outputs_.emplace(scene, options.out);
    if (from)
      load(*from);
    else if (const dem::Solids* solids = simulation_->solids())
      warn_of_start(*solids);
    series_.emplace(open_series(options.out / "series.h5", from, monitor));
    observers_->declare(*series_);
    const dem::Solids* solids = simulation_->solids();
    const double step = simulation_->time_step();
    if (!simulation_->fluid())
      monitor.log.info("{} particles, particle step {:.4g} s", solids->particles().size(), step);
    else
      monitor.log.info("{} particles, fluid step {:.4g} s, {} particle steps in it",
                       solids ? solids->particles().size() : 0, step,
                       solids ? std::llround(step / solids->options().time_step) : 0);
  }

  RunResult run() {
    monitor_.begin();
    monitor_.progress.start_from(time());  // the preparation is no time of a step
    watch_for_interrupt();
    RunResult result;
    for (;;) {
      const bool end = time() >= scene_.run.duration - 1e-9 * simulation_->time_step();
      result.interrupted = interrupted() && !end;
      if (end || result.interrupted) watch(*simulation_);
      const bool behind = loop_.rows.is_behind(time());
      const bool due = behind && (scene_.run.series_interval <= 0 || loop_.rows.due(time()));
      if (due) sample();
      {
        const ScopedTimer timer(timers_.section("outputs"));
        outputs_->write_due(*simulation_);
      }
      // Before what only the end of a run writes: a run that goes on is the same as one that was never stopped.
      if (result.interrupted || checkpoint_due(end)) save(end, result);
      if (end && !due && behind) sample();
      if (end || result.interrupted) break;
      simulation_->advance();
      observers_->after_step();
      remove_leavers(scene_, simulation_->solids());
      monitor_.progress.update(time());
    }
    finish(result);
    return result;
  }

 private:
  [[nodiscard]] double time() const { return simulation_->time(); }

  void warn_of_start(const dem::Solids& solids) {
    for (const std::string& missed : missed_heights(scene_, solids.particles())) monitor_.warn(missed);
    if (const std::string burst = burst_at_start(solids); !burst.empty()) monitor_.warn(burst);
    const FluidView* fluid = simulation_->fluid();
    if (fluid && !scene_.fluid.regions.empty() && fluid->liquid_mass() <= 0)
      monitor_.warn("at the start there is no liquid: walls and bodies fill all that is fluid.region");
  }

  void sample() {
    const ScopedTimer timer(timers_.section("measurements"));
    observers_->sample(*series_);
    loop_.rows.note(time());
    for (const std::string& refusal : {series_->refusal(), outputs_->refusal()})
      if (!refusal.empty() && told_.insert(refusal).second)
        monitor_.warn(refusal + ": others see it as it was, the run goes on");
  }

  /// On the way only when the last step of the fluid went well, so that the last checkpoint is a good one. The end has
  /// been watched.
  bool checkpoint_due(bool end) {
    const scene::Run& run = scene_.run;
    if (end) return run.checkpoint_interval > 0 || run.checkpoint_wall > 0;
    if (simulation_->fluid() && !simulation_->fluid()->is_in_order()) return false;
    return loop_.checkpoints.due(time()) ||
           (run.checkpoint_wall > 0 && monitor_.seconds() - last_checkpoint_ >= run.checkpoint_wall);
  }

  /// The outputs come last: loading them drops later files, when all else has been found whole.
  void transfer(Archive& archive) {
    archive.part("loop", loop_);
    archive.part("step", *simulation_);
    archive.part("observers", *observers_);
    archive.part("timers", timers_);
    TimersOfParts parts{*simulation_};
    archive.part("timers_of_parts", parts);
    archive.part("outputs", *outputs_);
  }
  struct TimersOfParts {
    Simulation& simulation;
    void transfer(Archive& archive) { simulation.transfer_timers(archive); }
  };

  /// A checkpoint on the way that cannot be written is a pity, the last one a failure, told when the results are whole.
  /// Who goes on from one on the way needs the rows and frames until then in the files that others see; as the run ends
  /// these get what has grown itself.
  void save(bool end, RunResult& result) {
    const ScopedTimer timer(timers_.section("checkpoints"));
    loop_.checkpoints.skip_until(time());
    last_checkpoint_ = monitor_.seconds();
    try {
      series_->flush();
      outputs_->flush();
    } catch (const CannotCopy& e) {
      if (!end && !result.interrupted) return monitor_.log.warn("no checkpoint at t = {:.6g} s: {}", time(), e.what());
    }
    loop_.wall_seconds = earlier_seconds_ + monitor_.seconds();
    loop_.peak_rss_bytes = std::max<std::uint64_t>(loop_.peak_rss_bytes, peak_rss_bytes());
    try {
      write_checkpoint(options_.out, scene_, {time(), observers_->last_time(), commits_},
                       [&](Archive& archive) { transfer(archive); });
      monitor_.log.info("checkpoint at t = {:.6g} s", time());
    } catch (const FileError& e) {
      if (end || result.interrupted) result.no_checkpoint = e;
      monitor_.log.warn("no checkpoint at t = {:.6g} s: {}", time(), e.what());
    }
    last_checkpoint_ = monitor_.seconds();
  }

  void load(const CheckpointHead& from) {
    load_checkpoint(options_.out, [&](Archive& archive) { transfer(archive); });
    replace_text_file(options_.out / "scene.resolved.toml", scene::to_toml(scene_));
    earlier_seconds_ = loop_.wall_seconds;
    if (const std::string lost = outputs_->lost(); !lost.empty()) monitor_.warn(lost);
    monitor_.log.info("goes on from the checkpoint of t = {:.6g} s", time());
    commits_ = from.commit;
    if (!commits_.ends_with(commit())) {
      monitor_.log.warn("the checkpoint is from commit {}, this is {}: results may differ from a run in one piece",
                        commits_, commit());
      commits_ += ", " + commit();
    }
  }

  void finish(RunResult& result) {
    {
      const ScopedTimer timer(timers_.section("outputs"));
      outputs_->finish(*simulation_);
      series_->close();
      observers_->finish(options_.out);
    }
    result.earlier_seconds = earlier_seconds_;
    Summary& summary = result.summary;
    summary.commit = commits_;
    summary.simulated_seconds = time();
    summary.metrics = observers_->metrics();
    summary.checks = observers_->checks();
    summary.timers = timers_.seconds();
    summary.performance.peak_rss_bytes = loop_.peak_rss_bytes;
    fill_performance(*simulation_, *observers_, summary);
    for (const std::string& warning : observers_->warnings()) monitor_.log.warn("{}", warning);
  }

  const scene::Scene& scene_;
  const RunOptions& options_;
  RunMonitor& monitor_;
  Timers timers_;
  Loop loop_;
  std::unique_ptr<Simulation> simulation_;
  std::optional<SeriesWriter> series_;
  std::optional<ObserverList> observers_;
  std::optional<Outputs> outputs_;
  double earlier_seconds_ = 0, last_checkpoint_ = 0;
  std::set<std::string> told_;      // what was warned of on the way
  std::string commits_ = commit();  // of all programs that had a part in this run
};

}  // namespace

void RunMonitor::warn(const std::string& text) {
  const std::string line = scene::on_one_line(text);
  log.warn("{}", line);
  tell(fmt::format("warning: {}\n", line));
}

RunResult run_scene(const scene::Scene& scene, const RunOptions& options, RunMonitor& monitor) {
  SceneRun run(scene, options, monitor);
  return run.run();
}

}  // namespace lahar::cases
