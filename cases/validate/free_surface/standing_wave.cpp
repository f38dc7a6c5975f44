#include "cases/validate/free_surface/standing_wave.h"

#include <cmath>
#include <numbers>
#include <string>

#include "cases/validate/free_surface/surface_flows.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

constexpr int kWidth = 8;  // cells

double level_of(const StandingWave& wave) {
  return 0.625 * wave.wavelength + 0.3;  // kh = 4; not at a special place of a cell
}

double initial_amplitude(const StandingWave& wave) { return 0.01 * wave.wavelength; }

/// Mean of a cosine over a column of width 1, over its value in the middle.
double column_mean(const StandingWave& wave) {
  const double half = wave.wave_number() / 2;
  return std::sin(half) / half;
}

/// Amplitude of the cosine in the columns' heights, in units of the initial one.
template <class Real>
double measured_amplitude(const lbm::Fluid<Real>& fluid, const StandingWave& wave) {
  double sum = 0;
  fluid.for_each_wet_cell(
      [&](const lbm::WetCell& c) { sum += c.liquid_volume * std::cos(wave.wave_number() * c.centre.x()); });
  return 2 * sum / (wave.wavelength * kWidth) / (initial_amplitude(wave) * column_mean(wave));
}

double at(const std::vector<double>& series, double step) {
  const auto n = static_cast<std::size_t>(step);
  return std::lerp(series.at(n), series.at(n + 1), step - static_cast<double>(n));
}

}  // namespace

double StandingWave::wave_number() const { return 2 * std::numbers::pi / wavelength; }
double StandingWave::gravity() const { return wave_speed * wave_speed * wave_number(); }
double StandingWave::frequency() const {
  return std::sqrt(gravity() * wave_number() * std::tanh(wave_number() * level_of(*this)));
}
double StandingWave::period() const { return 2 * std::numbers::pi / frequency(); }

template <class Real>
std::vector<double> run_standing_wave(const StandingWave& wave, double periods) {
  const double k = wave.wave_number(), level = level_of(wave);
  const Vec3i cells(wave.wavelength, kWidth, static_cast<int>(level) + 8);
  lbm::FluidOptions o = open_tank(cells, wave.frequency() / (wave.reynolds * k * k), Vec3(0, 0, -wave.gravity()));
  o.collision = wave.collision;
  o.smagorinsky = wave.smagorinsky;
  o.domain.faces.fill(lbm::FaceKind::periodic);
  o.domain.faces[4] = o.domain.faces[5] = lbm::FaceKind::open;
  o.domain.walls.add({"bottom", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::free_slip});
  lbm::Fluid<Real> fluid(o);
  const double amplitude = initial_amplitude(wave) * column_mean(wave);
  fluid.fill(liquid_under(cells, [&](double x) { return level + amplitude * std::cos(k * x); }));
  std::vector<double> series{measured_amplitude(fluid, wave)};
  const auto steps = static_cast<int>(std::ceil(periods * wave.period())) + 1;
  for (int s = 0; s < steps; ++s) {
    fluid.step();
    series.push_back(measured_amplitude(fluid, wave));
  }
  return series;
}

std::vector<double> exact_amplitude(int reynolds) {
  std::vector<double> amplitude =
      reference("gravity_wave_prosperetti.csv").where("Re", std::to_string(reynolds)).numbers("a_over_a0");
  amplitude.resize(kWaveQuarters + 1);
  return amplitude;
}

double amplitude_error(const std::vector<double>& series, const StandingWave& wave, int quarters) {
  const std::vector<double> exact = exact_amplitude(static_cast<int>(wave.reynolds));
  double squares = 0;
  for (int q = 0; q <= quarters; ++q) {
    const double error = at(series, 0.25 * q * wave.period()) - exact.at(static_cast<std::size_t>(q));
    squares += error * error;
  }
  return std::sqrt(squares / (quarters + 1));
}

template std::vector<double> run_standing_wave<float>(const StandingWave&, double);
template std::vector<double> run_standing_wave<double>(const StandingWave&, double);

}  // namespace lahar::validate
