// A column of water runs onto a wall, the scene cases/dam_break_lobovsky: speed of the front, impulse, peak and ringing
// of the pressure at the lowest sensor and of the force on the wall. The lattice fluid is softer than water: where a
// front meets a wall it makes a pulse of rho c u that lasts until the surface relieves it, and what is left runs to and
// fro in the water.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <variant>
#include <vector>

#include "cases/assembly/load.h"
#include "cases/assembly/simulation.h"
#include "cases/files/case_file.h"
#include "cases/observers/flow.h"
#include "cases/observers/fluid_samples.h"
#include "cases/pictures/chart.h"
#include "cases/validate/entry.h"
#include "cases/validate/free_surface/pulse.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

constexpr double kMillibar = 100;  // Pa
constexpr double kSpan = 0.005;    // s, of the largest mean

struct Impact {
  Samples pressure;                       ///< mbar, at every step
  Samples force;                          ///< on the end wall, N, mean of every step
  Samples lost;                           ///< N: by the liquid of its momentum, less what other walls took
  std::vector<double> front_time, front;  ///< T, Z
};

/// What walls got along x, N s.
struct WallImpulses {
  double end = 0, others = 0;
};

WallImpulses wall_impulses(const cases::FluidView& fluid) {
  const auto& loads = fluid.wall_loads();
  const auto& walls = fluid.domain().walls().all();
  WallImpulses got;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const auto* plane = std::get_if<HalfSpace>(&walls[k].shape);
    (plane && plane->normal.x() < -0.5 ? got.end : got.others) += loads[k].impulse.x();
  }
  return got;
}

Impact run_onto_wall(const scene::Scene& scene) {
  constexpr double height = 0.6;  // m, of the column, 0.6 m long too
  constexpr int every = 5;        // steps between two looks at the front
  const auto simulation = cases::build_simulation(scene);
  cases::FluidView& fluid = *simulation->fluid();
  fluid.measure_walls();
  const cases::Observed run(scene, *simulation);
  const cases::Bed bed(fluid.domain());
  const Vec3 sensor = scene.probes.front().position;
  Impact found;
  WallImpulses got;
  double momentum = simulation->liquid_momentum().x();
  for (int step = 1; simulation->time() < scene.run.duration; ++step) {
    simulation->advance();
    const double time = simulation->time(), dt = simulation->time_step();
    for (Samples* s : {&found.pressure, &found.force, &found.lost}) s->time.push_back(time);
    found.pressure.value.push_back(cases::pressure_at(fluid, sensor) / kMillibar);
    const WallImpulses now = wall_impulses(fluid);
    const double left = simulation->liquid_momentum().x();
    found.force.value.push_back((now.end - got.end) / dt);
    found.lost.value.push_back((momentum - left - (now.others - got.others)) / dt);
    got = now, momentum = left;
    if (step % every != 0) continue;
    found.front_time.push_back(time * std::sqrt(scene.gravity.magnitude / height));
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

/// Over this time (rise and decay of the experiment) from the first 10 mbar on.
Window pulse_of(const Samples& pressure, double duration) {
  const std::vector<double>& p = pressure.value;
  const auto first = std::find_if(p.begin(), p.end(), [](double x) { return x > 10; });
  if (first == p.end()) throw std::runtime_error("no water reaches the sensor");
  return window_from(pressure, static_cast<std::size_t>(first - p.begin()), duration);
}

double peak(const Samples& s, const Window& w) {
  const auto at = [&](std::size_t k) { return s.value.begin() + static_cast<std::ptrdiff_t>(k); };
  return *std::max_element(at(w.first), at(w.last));
}

/// What the medians say of the largest mean over kSpan: that of a pulse of straight lines. A measured one that is more
/// pointed has less.
struct Measured {
  double slope, impulse, peak, duration, mean_over_peak;
};

Measured measured_impact() {
  const ReferenceTable table = reference("lobovsky2014_medians.csv");
  const auto known = [&](const char* name) { return table.where("quantity", name).number("value"); };
  const double rise = 1e-3 * known("rise time"), decay = 1e-3 * known("decay time");
  return {known("front slope dZ/dT"), known("pressure impulse"), known("peak pressure"), rise + decay,
          largest_mean_of_triangle(kSpan, rise, decay)};
}

/// Peaks, largest means and ringing of pressure and force. The force was not measured: its mean is held against what
/// the liquid loses of its momentum meanwhile, its peak against the mean.
void add_peaks(std::vector<Row>& rows, const std::string& what, const Impact& impact, const Window& pulse,
               const Measured& known) {
  const double raw = peak(impact.pressure, pulse);
  rows.push_back(relative_row(what + "peak pressure, mbar", raw, known.peak, 0.30));
  rows.push_back(relative_row(what + "largest mean pressure over 5 ms, mbar",
                              mean(impact.pressure, largest_mean(impact.pressure, pulse, kSpan)),
                              known.peak * known.mean_over_peak, 0.15));
  rows.push_back(
      at_most_row(what + "ringing after 10 ms, of the mean pressure", ringing(impact.pressure, pulse), 0.05));
  const Window stretch = largest_mean(impact.force, pulse, kSpan);
  const double force = mean(impact.force, stretch);
  rows.push_back(
      relative_row(what + "largest mean force on the wall over 5 ms, by the momentum that the water loses, N", force,
                   mean(impact.lost, stretch), 0.15));
  rows.push_back(relative_row(what + "peak force on the wall, by that mean and the measured pulse, N",
                              peak(impact.force, pulse), force / known.mean_over_peak, 0.30));
  rows.push_back(
      at_most_row(what + "ringing after 10 ms, of the mean force on the wall", ringing(impact.force, pulse), 0.05));
}

std::vector<Row> run(const Context& context) {
  const Measured known = measured_impact();
  std::vector<Row> rows;
  for (const char* slip : {"free_slip", "no_slip"}) {
    if (context.quick && slip[0] == 'n') continue;
    std::vector<std::string> set{context.quick ? "run.duration_s=0.65" : "run.duration_s=1.0",
                                 context.quick ? "fluid.cell_size_m=0.02" : "fluid.cell_size_m=0.01"};
    for (const char* wall : {"bed", "near_side", "far_side"})
      set.push_back(std::string("wall[") + wall + "].slip=" + slip);
    const Impact impact = run_onto_wall(scene::load(cases::case_file("dam_break_lobovsky/scene.toml"), set));
    const Window pulse = pulse_of(impact.pressure, known.duration);
    const std::string what = slip[0] == 'n' ? "walls that hold the water: " : "walls that slip: ";
    rows.push_back(relative_row(what + "front, dZ/dT", front_slope(impact), known.slope, context.quick ? 0.10 : 0.04));
    rows.push_back(relative_row(what + "impulse of the pressure, mbar s", integral(impact.pressure, pulse),
                                known.impulse, context.quick ? 0.20 : 0.10));
    if (context.quick) continue;
    add_peaks(rows, what, impact, pulse, known);
    if (context.plots.empty()) continue;
    cases::Chart chart{.title = "Pressure on the end wall", .x = {"time", "s"}, .y = {"pressure", "mbar"}};
    chart.series.push_back({.name = "sensor 1", .x = impact.pressure.time, .y = impact.pressure.value});
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
