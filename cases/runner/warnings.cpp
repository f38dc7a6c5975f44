#include "cases/runner/warnings.h"

#include <fmt/format.h>

#include <cmath>

#include "cases/runner/warnings_by_part.h"

namespace lahar::cases {
namespace {

double step_of(const CheckReport& figures) {
  return figures.fluid ? figures.fluid->time_step : figures.solids ? figures.solids->time_step : 0;
}

void add_duration(const scene::Scene& s, double step, Warnings& list) {
  if (s.run.duration < step)
    list.push_back(
        fmt::format("run.duration_s ({:g} s) is shorter than a time step ({:.2g} s): the run ends after one "
                    "step at most",
                    s.run.duration, step));
}

/// Intervals longer than the run, and files that would come with every step; rows of the series: see add_rows.
void add_intervals(const scene::Scene& s, double step, Warnings& list) {
  const auto longer = [&](double interval, const char* key) {
    if (interval > s.run.duration)
      list.push_back(fmt::format("run.{} ({:g} s) is longer than the run ({:g} s)", key, interval, s.run.duration));
  };
  const auto file = [&](double interval, const char* key) {
    longer(interval, key);
    if (interval > 0 && interval < step)
      list.push_back(fmt::format("run.{} ({:g} s) is less than the time step ({:.2g} s): files come with every step",
                                 key, interval, step));
  };
  longer(s.run.series_interval, "series_interval_s");
  file(s.run.output_interval, "output_interval_s");
  file(s.run.image_interval, "image_interval_s");
  file(s.run.force_map_interval, "force_map_interval_s");
  if (s.run.force_map_interval > 0 && !s.barrier.enabled)
    list.emplace_back("run.force_map_interval_s without a barrier: there are no wires to draw");
  file(s.run.checkpoint_interval, "checkpoint_interval_s");
}

/// Rows of the series come at the first step that has reached their time.
void add_rows(const scene::Scene& s, double step, Warnings& list) {
  if (step <= 0 || s.run.series_interval <= 0 || s.fluid.adaptive_time_step) return;
  const double steps = s.run.series_interval / step, between = std::abs(steps - std::round(steps));
  constexpr double bearable = 0.1;  // of the interval
  if (between > bearable * steps || steps < 1 - bearable)
    list.push_back(fmt::format("run.series_interval_s ({:g} s) is {:.2g} time steps: rows come every {} steps",
                               s.run.series_interval, steps,
                               steps < 1 ? "1" : fmt::format("{:.0f} or {:.0f}", std::floor(steps), std::ceil(steps))));
}

void add_gravity(const scene::Scene& s, Warnings& list) {
  constexpr double heavy = 30;  // m/s^2
  if (s.gravity.magnitude > heavy)
    list.push_back(fmt::format("gravity.magnitude_m_s2 is {:g}, on Earth it is 9.81", s.gravity.magnitude));
}

void add_measure(const scene::Scene& s, Warnings& list) {
  const scene::Measure usual;
  const bool section = scene::section_of(s).has_value();
  if (s.measure.inflow_distance != usual.inflow_distance && !(section && s.fluid.enabled))
    list.push_back(fmt::format("measure.inflow_distance_m changes nothing without {}",
                               section ? "a fluid" : "measure.section_x_m"));
  if (s.measure.outflow_distance != usual.outflow_distance && !section)
    list.emplace_back("measure.outflow_distance_m changes nothing without measure.section_x_m");
}

}  // namespace

std::vector<std::string> warnings(const scene::Scene& scene, const CheckReport& figures) {
  Warnings list;
  add_duration(scene, step_of(figures), list);
  add_intervals(scene, step_of(figures), list);
  add_gravity(scene, list);
  add_measure(scene, list);
  add_rows(scene, step_of(figures), list);
  warn_of_places(scene, figures.fluid.has_value(), list);
  if (figures.fluid) warn_of_fluid(scene, *figures.fluid, list);
  if (figures.solids) warn_of_solids(scene, *figures.solids, list);
  if (figures.fluid && figures.solids) warn_of_coupling(scene, *figures.solids, list);
  if (figures.solids) warn_of_contacts(scene, list), warn_of_packings(scene, list);
  return list;
}

}  // namespace lahar::cases
