// A standing wave on deep water at Reynolds number 1000 over two periods: Prosperetti 1981, the initial-value problem
// with viscosity.
#include <fmt/format.h>

#include "cases/speed_error/problems/problems.h"
#include "cases/validate/free_surface/standing_wave.h"

namespace lahar::validate {

namespace {

Trial trial(std::vector<Knob> turned, const StandingWave& wave, bool double_precision = false) {
  constexpr int quarters = 8;
  return {std::move(turned), [wave, double_precision] {
            return timed([&] {
              const std::vector<double> series = double_precision ? run_standing_wave<double>(wave, 0.25 * quarters)
                                                                  : run_standing_wave<float>(wave, 0.25 * quarters);
              return amplitude_error(series, wave, quarters);
            });
          }};
}

}  // namespace

Problem gravity_wave_problem(bool quick) {
  Problem p{"gravity_wave",
            "RMS of the error of the amplitude, of the initial one",
            "exact (Prosperetti 1981)",
            "32 cells a wavelength, wave speed 0.1 lu, central moments, float",
            {}};
  StandingWave standard;
  standard.wavelength = 32, standard.wave_speed = 0.1, standard.reynolds = 1000;
  p.trials.push_back(trial({}, standard));
  for (const int cells : {16, 64, 128}) {
    if (quick && cells > 64) continue;
    StandingWave w = standard;
    w.wavelength = cells;
    p.trials.push_back(trial({{"cells", fmt::to_string(cells)}}, w));
  }
  for (const double speed : {0.2, 0.05, 0.025}) {
    StandingWave w = standard;
    w.wave_speed = speed;
    p.trials.push_back(trial({{"lattice_velocity", fmt::to_string(speed)}}, w));
  }
  const std::pair<const char*, lbm::CollisionOperator> operators[] = {{"trt", lbm::Trt{}}, {"bgk", lbm::Bgk{}}};
  for (const auto& [name, collision] : operators) {
    StandingWave w = standard;
    w.collision = collision;
    p.trials.push_back(trial({{"collision", name}}, w));
  }
  StandingWave w = standard;
  w.smagorinsky = 0.16;
  p.trials.push_back(trial({{"smagorinsky", "0.16"}}, w));
  p.trials.push_back(trial({{"precision", "double"}}, standard, true));
  return p;
}

}  // namespace lahar::validate
