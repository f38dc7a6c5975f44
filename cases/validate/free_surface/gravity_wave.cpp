// A standing wave of small amplitude on deep water against Prosperetti 1981 (Physics of Fluids 24, 1217).
#include <string>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/standing_wave.h"
#include "cases/validate/free_surface/surface_charts.h"

namespace lahar::validate {
namespace {

template <class Real>
std::vector<Row> ask(const Context& context) {
  const int quarters = context.quick ? 4 : kWaveQuarters;
  std::vector<Row> rows;
  for (const int reynolds : {10, 100, 1000, 10000}) {
    if (context.quick && reynolds != 100) continue;
    StandingWave wave;
    wave.reynolds = reynolds;
    if (context.quick) wave.wavelength = 32;
    const std::vector<double> series = run_standing_wave<Real>(wave, 0.25 * quarters);
    // A grid of half the cells is asked for twice the error.
    rows.push_back(at_most_row("Re " + std::to_string(reynolds) + ", RMS of a / a0",
                               amplitude_error(series, wave, quarters), context.quick ? 0.06 : 0.03));
    draw_gravity_wave(context, reynolds, wave.period(), series, exact_amplitude(reynolds));
  }
  return rows;
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() { return ask<Real>(context); });
}

}  // namespace

Entry gravity_wave() {
  return {
      "free_surface.gravity_wave", {"Prosperetti 1981, Phys. Fluids 24:1217", {"gravity_wave_prosperetti.csv"}}, run};
}

}  // namespace lahar::validate
