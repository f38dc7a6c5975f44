// A column of water runs onto a wall, the scene cases/dam_break_lobovsky: speed of the front, impulse, peak and ringing
// of the pressure at the lowest sensor. The lattice fluid is softer than water: where a front meets a wall it makes a
// pulse of rho c u that lasts until the surface relieves it, and what is left runs to and fro in the water.
#include <algorithm>
#include <cmath>
#include <vector>

#include "cases/assembly/load.h"
#include "cases/assembly/simulation.h"
#include "cases/files/case_file.h"
#include "cases/observers/flow.h"
#include "cases/observers/fluid_samples.h"
#include "cases/pictures/chart.h"
#include "cases/validate/entry.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

constexpr double kMillibar = 100;  // Pa

struct Impact {
  std::vector<double> time, pressure;     ///< s, mbar, at every step
  std::vector<double> front_time, front;  ///< T, Z
};

Impact run_onto_wall(const scene::Scene& scene) {
  constexpr double height = 0.6;  // m, of the column, 0.6 m long too
  constexpr int every = 5;        // steps between two looks at the front
  const auto simulation = cases::build_simulation(scene);
  const cases::Observed run(scene, *simulation);
  const cases::Bed bed(simulation->fluid()->domain());
  const Vec3 sensor = scene.probes.front().position;
  Impact found;
  for (int step = 1; simulation->time() < scene.run.duration; ++step) {
    simulation->advance();
    found.time.push_back(simulation->time());
    found.pressure.push_back(cases::pressure_at(*simulation->fluid(), sensor) / kMillibar);
    if (step % every != 0) continue;
    found.front_time.push_back(simulation->time() * std::sqrt(scene.gravity.magnitude / height));
    found.front.push_back(cases::look_at_flow(run, bed).front / height);
  }
  return found;
}

/// Least-squares slope of the front where it is in free flow.
double front_slope(const Impact& impact) {
  double n = 0, t = 0, z = 0, tt = 0, tz = 0;
  for (std::size_t k = 0; k < impact.front.size(); ++k) {
    const double x = impact.front_time[k], y = impact.front[k];
    if (y > 1.3 && y < 2.5) n += 1, t += x, z += y, tt += x * x, tz += x * y;
  }
  return (n * tz - t * z) / (n * tt - t * t);
}

/// Of the pressure over 111 ms (rise and decay time of the experiment) from the first 10 mbar on.
struct Pulse {
  double impulse = 0, peak = 0;  ///< mbar s, mbar
  double ringing = 0;            ///< RMS of what a mean over 5 ms takes away, over the mean, from 10 ms on
};

Pulse pulse_of(const Impact& impact, double duration) {
  const std::vector<double>& p = impact.pressure;
  const auto first =
      static_cast<std::size_t>(std::find_if(p.begin(), p.end(), [](double x) { return x > 10; }) - p.begin());
  if (first == p.size()) return {};
  Pulse pulse;
  pulse.peak = *std::max_element(p.begin(), p.end());
  double squares = 0, mean = 0;
  int count = 0;
  for (std::size_t k = first; k + 1 < p.size() && impact.time[k] < impact.time[first] + duration; ++k) {
    const double dt = impact.time[k + 1] - impact.time[k];
    pulse.impulse += p[k] * dt;
    const auto half = static_cast<std::size_t>(0.0025 / dt);
    if (impact.time[k] < impact.time[first] + 0.010 || k + half >= p.size()) continue;
    double local = 0;
    for (std::size_t i = k - half; i <= k + half; ++i) local += p[i] / static_cast<double>(2 * half + 1);
    squares += (p[k] - local) * (p[k] - local), mean += p[k], ++count;
  }
  pulse.ringing = std::sqrt(squares * count) / mean;
  return pulse;
}

std::vector<Row> run(const Context& context) {
  const ReferenceTable table = reference("lobovsky2014_medians.csv");
  const auto known = [&](const char* name) { return table.where("quantity", name).number("value"); };
  const double duration = 1e-3 * (known("rise time") + known("decay time"));
  std::vector<Row> rows;
  for (const char* slip : {"free_slip", "no_slip"}) {
    if (context.quick && slip[0] == 'n') continue;
    std::vector<std::string> set{context.quick ? "run.duration_s=0.65" : "run.duration_s=1.0",
                                 context.quick ? "fluid.cell_size_m=0.02" : "fluid.cell_size_m=0.01"};
    for (const char* wall : {"bed", "near_side", "far_side"})
      set.push_back(std::string("wall[") + wall + "].slip=" + slip);
    const Impact impact = run_onto_wall(scene::load(cases::case_file("dam_break_lobovsky/scene.toml"), set));
    const Pulse pulse = pulse_of(impact, duration);
    const std::string what = slip[0] == 'n' ? "walls that hold the water: " : "walls that slip: ";
    rows.push_back(relative_row(what + "front, dZ/dT", front_slope(impact), known("front slope dZ/dT"),
                                context.quick ? 0.10 : 0.04));
    rows.push_back(relative_row(what + "impulse of the pressure, mbar s", pulse.impulse, known("pressure impulse"),
                                context.quick ? 0.20 : 0.10));
    if (context.quick) continue;
    rows.push_back(relative_row(what + "peak pressure, mbar", pulse.peak, known("peak pressure"), 0.30));
    rows.push_back(at_most_row(what + "ringing after 10 ms, of the mean pressure", pulse.ringing, 0.05));
    if (context.plots.empty()) continue;
    cases::Chart chart{.title = "Pressure on the end wall", .x = {"time", "s"}, .y = {"pressure", "mbar"}};
    chart.series.push_back({.name = "sensor 1", .x = impact.time, .y = impact.pressure});
    chart.write_all(context.plots / (std::string("impact_on_wall_") + slip + ".png"));
  }
  return rows;
}

}  // namespace

Entry impact_on_wall() {
  return {
      "free_surface.impact_on_wall", {"Lobovsky et al. 2014, medians, second hand", {"lobovsky2014_medians.csv"}}, run};
}

}  // namespace lahar::validate
