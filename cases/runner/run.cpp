#include "cases/runner/run.h"

#include <algorithm>
#include <cmath>

#include "cases/assembly/build.h"
#include "cases/assembly/estimates.h"
#include "cases/observers/measurements.h"
#include "cases/runner/checkpoint.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/machine.h"
#include "cases/runner/outputs.h"
#include "cases/runner/schedule.h"
#include "core/check.h"

namespace lahar::cases {

namespace {

/// The solvers of a scene, put together.
template <class Real>
struct Solvers {
  std::optional<barrier::Net> net;
  std::optional<coupling::CoupledStep<Real>> step;
};

/// `resumed` leaves out what a checkpoint brings along: where the grains and the liquid are.
template <class Real>
void build_solvers(const scene::Scene& scene, bool resumed, Solvers<Real>& s) {
  std::optional<lbm::FluidOptions> fluid;
  if (scene.fluid.enabled) fluid = fluid_options(scene);
  std::optional<dem::Solids> solids;
  if (scene.has_solids()) {
    BuiltSolids built = build_solids(scene, resumed ? GrainStart::placeholders : GrainStart::packed);
    solids.emplace(std::move(built.solids));
    s.net = std::move(built.net);
  }
  coupling::CouplingOptions options;
  options.immersed_grains = scene.coupling.enabled;
  options.wire_drag = scene.coupling.enabled && scene.coupling.wire_drag;
  if (scene.coupling.enabled && scene.coupling.resolve_wires_from_cells)
    options.resolve_wires_from = *scene.coupling.resolve_wires_from_cells;
  options.lubrication = scene.coupling.lubrication;
  options.radius_shift = scene.coupling.radius_shift_cells;
  options.substeps = substeps_of(scene);
  s.step.emplace(std::move(fluid), std::move(solids), options);
  if (s.step->fluid() && !resumed) s.step->fill(liquid_regions(scene));
}

/// Grains that have gone through an open face are taken out of the scene.
template <class Real>
void remove_leavers(const scene::Scene& scene, coupling::CoupledStep<Real>& step) {
  if (!step.solids()) return;
  const dem::Particles& p = step.solids()->particles();
  for (dem::ParticleIndex i = 0; i < p.size(); ++i) {
    if (p.kind[i] != dem::ParticleKind::grain || p.state[i] != dem::ParticleState::free) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = p.position[i][axis];
      const bool below = x<scene.domain.lower[axis] - p.radius[i], above = x> scene.domain.upper[axis] + p.radius[i];
      if ((below && scene.domain.open(static_cast<scene::Face>(2 * axis))) ||
          (above && axis != 2 && scene.domain.open(static_cast<scene::Face>(2 * axis + 1)))) {
        step.solids()->remove(i);
        break;
      }
    }
  }
}

template <class Real>
void fill_performance(coupling::CoupledStep<Real>& step, Summary& summary) {
  auto timers = step.timers().seconds();
  if (step.fluid()) {
    for (const auto& [name, seconds] : step.fluid()->timers().seconds()) timers[name] = seconds;
    if (timers["fluid"] > 0) summary.performance.mlups = step.fluid()->cell_updates() / timers["fluid"] / 1e6;
  }
  if (step.solids()) {
    for (const auto& [name, seconds] : step.solids()->timers().seconds()) timers["solids." + name] = seconds;
    const auto n = static_cast<double>(step.solids()->particles().size());
    if (timers["solids"] > 0)
      summary.performance.dem_particle_steps_per_second =
          n * static_cast<double>(step.solids()->step_count()) / timers["solids"];
  }
  summary.timers.insert(timers.begin(), timers.end());
}

template <class Real>
void note_sizes(coupling::CoupledStep<Real>& step, Performance& performance) {
  if (!step.fluid()) return;
  performance.wet_cells_max = std::max<std::uint64_t>(performance.wet_cells_max, step.fluid()->wet_cells());
  performance.blocks_max = std::max<std::uint64_t>(performance.blocks_max, step.fluid()->grid().active().size());
}

template <class Real>
void add_checks(const Measurements<Real>& measurements, bool has_net, Summary& summary) {
  const auto check = [&](const char* name, const char* metric, double tolerance, const char* source) {
    const auto found = summary.metrics.find(metric);
    if (found == summary.metrics.end()) return;
    summary.checks.push_back({name, found->second, 0, tolerance, std::abs(found->second) <= tolerance, source});
  };
  check("liquid_mass_ledger", "liquid_mass_drift_rel", 1e-4, "conservation of mass");
  check("momentum_audit", "momentum_audit_rel", 1e-6, "action = reaction");
  if (!has_net) return;
  const bool kept = measurements.lost_links().empty();
  summary.checks.push_back({"ring_links_changed", kept ? 0.0 : 1.0, 0, 0, kept, "linking numbers at the start"});
}

/// What the loop itself has to remember.
struct Loop {
  explicit Loop(const scene::Scene& scene) : checkpoints(scene.run.checkpoint_interval) { checkpoints.skip_until(0); }

  double next_sample = 0;   ///< s
  double wall_seconds = 0;  ///< of the run, when the checkpoint was written
  Performance performance;
  Schedule checkpoints;

  void transfer(Archive& archive) {
    archive.value("next_sample", next_sample);
    archive.value("wall_seconds", wall_seconds);
    archive.value("peak_rss_bytes", performance.peak_rss_bytes);
    archive.value("wet_cells_max", performance.wet_cells_max);
    archive.value("blocks_max", performance.blocks_max);
    archive.part("checkpoints", checkpoints);
  }
};

template <class Real>
SeriesWriter open_series(const std::filesystem::path& path, const std::optional<CheckpointHead>& from,
                         RunMonitor& monitor) {
  if (!from) return SeriesWriter(path);
  if (std::filesystem::exists(path)) {
    try {
      return SeriesWriter::resume(path, from->last_row);
    } catch (const FileError& e) {
      throw InputError(std::vector<InputMistake>{
          {path.string(), 1, 1,
           std::string("cannot be gone on with (") + e.what() + "), expected the series of the run, or none"}});
    }
  }
  monitor.log.warn("{} is gone: the series begins anew", path.string());
  return SeriesWriter(path);
}

template <class Real>
class SceneRun {
 public:
  SceneRun(const scene::Scene& scene, const RunOptions& options, RunMonitor& monitor)
      : scene_(scene), options_(options), monitor_(monitor), loop_(scene) {
    std::optional<CheckpointHead> from;
    if (options.resume) from = read_head(options.out, scene);
    {
      const ScopedTimer timer(timers_.section("preparation"));
      build_solvers(scene, options.resume, solvers_);
    }
    series_.emplace(open_series<Real>(options.out / "series.h5", from, monitor));
    measurements_.emplace(scene, step(), solvers_.net ? &*solvers_.net : nullptr, *series_);
    outputs_.emplace(scene, options.out);
    if (from) load(*from);
    monitor.log.info("{} particles, fluid step {:.4g} s, {} particle steps in it",
                     step().solids() ? step().solids()->particles().size() : 0, step().time_step(), substeps_of(scene));
  }

  RunResult run() {
    RunResult result;
    for (;;) {
      const bool due = step().time() >= loop_.next_sample - 1e-12;
      if (due) sample();
      {
        const ScopedTimer timer(timers_.section("outputs"));
        outputs_->write_due(step());
      }
      const bool end = step().time() >= scene_.run.duration - 1e-9 * step().time_step();
      result.interrupted = interrupted() && !end;
      // Before what only the end of a run writes: a run that goes on is the same as one that was never stopped.
      if (result.interrupted || checkpoint_due(end)) save(result.interrupted);
      if (end && !due) sample();
      if (end || result.interrupted) break;
      step().advance();
      measurements_->after_step();
      remove_leavers(scene_, step());
      monitor_.progress.update(step().time());
    }
    finish(result);
    return result;
  }

 private:
  coupling::CoupledStep<Real>& step() { return *solvers_.step; }

  void sample() {
    const ScopedTimer timer(timers_.section("measurements"));
    measurements_->sample();
    note_sizes(step(), loop_.performance);
    loop_.next_sample = step().time() + scene_.run.series_interval;
  }

  /// Only when the last step of the fluid went well, so that the last checkpoint is a good one.
  bool checkpoint_due(bool end) {
    const scene::Run& run = scene_.run;
    if (end) return run.checkpoint_interval > 0 || run.checkpoint_wall > 0;
    if (step().fluid() && !step().fluid()->is_in_order()) return false;
    return loop_.checkpoints.due(step().time()) ||
           (run.checkpoint_wall > 0 && monitor_.seconds() - last_checkpoint_ >= run.checkpoint_wall);
  }

  void transfer(Archive& archive) {
    archive.part("loop", loop_);
    archive.part("step", step());
    archive.part("measurements", *measurements_);
    archive.part("outputs", *outputs_);
    archive.part("timers", timers_);
    TimersOfParts parts{step()};
    archive.part("timers_of_parts", parts);
  }
  struct TimersOfParts {
    coupling::CoupledStep<Real>& step;
    void transfer(Archive& archive) { step.transfer_timers(archive); }
  };

  /// A checkpoint on the way that cannot be written is a pity, the last one a failure.
  void save(bool last) {
    const ScopedTimer timer(timers_.section("checkpoints"));
    series_->flush();
    loop_.wall_seconds = earlier_seconds_ + monitor_.seconds();
    loop_.performance.peak_rss_bytes = std::max(loop_.performance.peak_rss_bytes, peak_rss_bytes());
    loop_.checkpoints.skip_until(step().time());
    try {
      write_checkpoint(options_.out, scene_, {step().time(), measurements_->last_time(), commit()},
                       [&](Archive& archive) { transfer(archive); });
      monitor_.log.info("checkpoint at t = {:.6g} s", step().time());
    } catch (const FileError& e) {
      if (last) throw;
      monitor_.log.warn("no checkpoint at t = {:.6g} s: {}", step().time(), e.what());
    }
    last_checkpoint_ = monitor_.seconds();
  }

  void load(const CheckpointHead& from) {
    load_checkpoint(options_.out, [&](Archive& archive) { transfer(archive); });
    earlier_seconds_ = loop_.wall_seconds;
    monitor_.progress.start_from(step().time());
    monitor_.log.info("goes on from the checkpoint of t = {:.6g} s", step().time());
    if (from.commit != commit())
      monitor_.log.warn("the checkpoint is from commit {}: results may differ in rounding from a run in one piece",
                        from.commit);
  }

  void finish(RunResult& result) {
    {
      const ScopedTimer timer(timers_.section("outputs"));
      outputs_->finish(step());
      if (auto lines = measurements_->cable_chart(); !lines.empty())
        Chart{.title = "Sum of bond forces in the cables",
              .x = {"time", "s"},
              .y = {"force", "kN"},
              .series = std::move(lines)}
            .write_all(options_.out / "cable_forces.png");
    }
    result.earlier_seconds = earlier_seconds_;
    result.summary.performance = loop_.performance;
    result.summary.simulated_seconds = step().time();
    result.summary.metrics = measurements_->metrics();
    add_checks(*measurements_, solvers_.net.has_value(), result.summary);
    result.summary.timers = timers_.seconds();
    fill_performance(step(), result.summary);
    if (const std::string lost = measurements_->lost_links(); !lost.empty()) monitor_.log.warn("{}", lost);
  }

  const scene::Scene& scene_;
  const RunOptions& options_;
  RunMonitor& monitor_;
  Timers timers_;
  Loop loop_;
  Solvers<Real> solvers_;
  std::optional<SeriesWriter> series_;
  std::optional<Measurements<Real>> measurements_;
  std::optional<Outputs<Real>> outputs_;
  double earlier_seconds_ = 0, last_checkpoint_ = 0;
};

template <class Real>
RunResult run_with(const scene::Scene& scene, const RunOptions& options, RunMonitor& monitor) {
  SceneRun<Real> run(scene, options, monitor);
  return run.run();
}

}  // namespace

RunResult run_scene(const scene::Scene& scene, const RunOptions& options, RunMonitor& monitor) {
  if (scene.run.precision == scene::Precision::float64) return run_with<double>(scene, options, monitor);
  return run_with<float>(scene, options, monitor);
}

}  // namespace lahar::cases
