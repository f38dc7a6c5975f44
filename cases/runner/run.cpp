#include "cases/runner/run.h"

#include <cmath>

#include "cases/observers/png_file.h"
#include "cases/runner/build.h"
#include "cases/runner/estimates.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/measurements.h"
#include "cases/runner/outputs.h"

namespace lahar::cases {

namespace {

/// The solvers of a scene, put together.
template <class Real>
struct Solvers {
  std::optional<barrier::Net> net;
  std::optional<coupling::CoupledStep<Real>> step;
};

template <class Real>
void build_solvers(const scene::Scene& scene, Solvers<Real>& s) {
  std::optional<lbm::FluidOptions> fluid;
  if (scene.fluid.enabled) fluid = fluid_options(scene);
  std::optional<dem::Solids> solids;
  if (scene.has_solids()) {
    BuiltSolids built = build_solids(scene);
    solids.emplace(std::move(built.solids));
    s.net = std::move(built.net);
  }
  coupling::CouplingOptions options;
  options.immersed_grains = scene.coupling.enabled;
  options.wire_drag = scene.coupling.enabled && scene.coupling.wire_drag;
  options.lubrication = scene.coupling.lubrication;
  options.radius_shift = scene.coupling.radius_shift_cells;
  options.substeps = substeps_of(scene);
  s.step.emplace(std::move(fluid), std::move(solids), options);
  if (s.step->fluid()) s.step->fill(liquid_regions(scene));
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

template <class Real>
RunResult run_with(const scene::Scene& scene, const RunOptions& options, RunMonitor& monitor) {
  RunResult result;
  Timers timers;
  Solvers<Real> solvers;
  {
    const ScopedTimer timer(timers.section("preparation"));
    build_solvers(scene, solvers);
  }
  auto& step = *solvers.step;
  monitor.log.info("{} particles, fluid step {:.4g} s, {} particle steps in it",
                   step.solids() ? step.solids()->particles().size() : 0, step.time_step(), substeps_of(scene));
  SeriesWriter series(options.out / "series.h5");
  Measurements<Real> measurements(scene, step, solvers.net ? &*solvers.net : nullptr, series);
  Outputs<Real> outputs(scene, options.out);
  const auto steps = static_cast<std::int64_t>(std::ceil(scene.run.duration / step.time_step() - 1e-9));
  double next_sample = 0;
  for (std::int64_t k = 0;; ++k) {
    if (step.time() >= next_sample - 1e-12 || k == steps) {
      const ScopedTimer timer(timers.section("measurements"));
      measurements.sample();
      note_sizes(step, result.summary.performance);
      next_sample = step.time() + scene.run.series_interval;
    }
    {
      const ScopedTimer timer(timers.section("outputs"));
      outputs.write_due(step);
    }
    result.interrupted = interrupted();
    if (k == steps || result.interrupted) break;
    step.advance();
    measurements.after_step();
    remove_leavers(scene, step);
    monitor.progress.update(step.time());
  }
  {
    const ScopedTimer timer(timers.section("outputs"));
    outputs.finish(step);
    if (const auto lines = measurements.cable_chart(); !lines.empty())
      write_png(
          options.out / "cable_forces.png",
          draw_chart(lines, {.title = "Sum of bond forces in the cables", .x_label = "time, s", .y_label = "kN"}));
  }
  result.summary.simulated_seconds = step.time();
  result.summary.metrics = measurements.metrics();
  add_checks(measurements, solvers.net.has_value(), result.summary);
  result.summary.timers = timers.seconds();
  fill_performance(step, result.summary);
  if (const std::string lost = measurements.lost_links(); !lost.empty()) monitor.log.warn("{}", lost);
  return result;
}

}  // namespace

RunResult run_scene(const scene::Scene& scene, const RunOptions& options, RunMonitor& monitor) {
  if (scene.run.precision == scene::Precision::float64) return run_with<double>(scene, options, monitor);
  return run_with<float>(scene, options, monitor);
}

}  // namespace lahar::cases
