// A standing wave of small amplitude on deep water, from rest, against Prosperetti 1981 (Physics of Fluids 24, 1217:
// the initial-value problem with viscosity). The amplitude of 0.01 wavelengths is less than a cell: a surface that is
// known only to the cell does not feel it.
#include <array>
#include <cmath>
#include <numbers>

#include "cases/validate/fluid/surface_charts.h"
#include "cases/validate/fluid/surface_entries.h"
#include "cases/validate/fluid/surface_flows.h"

namespace lahar::validate {
namespace {

constexpr int kSamples = 17;  ///< every quarter of a period, four periods

struct Wave {
  double reynolds;                         ///< omega_0 / (nu k^2)
  std::array<double, kSamples> amplitude;  ///< a / a_0
};

/// Copied from the table gravity_wave_prosperetti.csv: "Standing gravity wave, deep water, small amplitude, from rest;
/// COMPUTED from Prosperetti 1981 single-fluid solution (formula recalled, checked a(0)=1 and Lamb decay limit
/// exp(-2 nu k^2 t))".
const std::vector<Wave> kWaves = {
    {10,
     {1.0, 0.144797, -0.637631, -0.173693, 0.365603, 0.13879, -0.216236, -0.111747, 0.119618, 0.079831, -0.066946,
      -0.057372, 0.034623, 0.0385, -0.017846, -0.026035, 0.008027}},
    {100,
     {1.0, 0.018446, -0.945707, -0.023148, 0.890691, 0.024599, -0.840983, -0.02759, 0.792502, 0.028821, -0.747993,
      -0.030894, 0.705, 0.031754, -0.665276, -0.033165, 0.627085}},
    {1000,
     {1.0, 0.001955, -0.993972, -0.002152, 0.987828, 0.002228, -0.981821, -0.002391, 0.975773, 0.00248, -0.969828,
      -0.002629, 0.963862, 0.002722, -0.957983, -0.002863, 0.952094}},
    {10000,
     {1.0, 0.000199, -0.99938, -0.000205, 0.998754, 0.000208, -0.998133, -0.000214, 0.997509, 0.000217, -0.996888,
      -0.000222, 0.996265, 0.000225, -0.995645, -0.000231, 0.995023}},
};

struct Tank {
  int wavelength = 64;          ///< cells
  double wave_speed = 0.03;     ///< lu; compression changes the period by about the square of its Mach number, 0.3 %
  double gravity = 0;           ///< lu
  double level = 0, depth = 0;  ///< cells
  double k = 0, omega = 0;

  explicit Tank(int cells) : wavelength(cells) {
    k = 2 * std::numbers::pi / wavelength;
    gravity = wave_speed * wave_speed * k;
    level = depth = 0.625 * wavelength + 0.3;  // kh = 4; not at a special place of a cell
    omega = std::sqrt(gravity * k * std::tanh(k * depth));
  }
  [[nodiscard]] double amplitude() const { return 0.01 * wavelength; }
  /// Mean of the initial surface over the column of width 1 around x.
  [[nodiscard]] double surface(double x) const {
    return level + amplitude() * std::cos(k * x) * std::sin(k / 2) / (k / 2);
  }
};

/// Amplitude of the cosine in the columns' heights, in units of the initial one.
template <class Real>
double measured_amplitude(const lbm::Fluid<Real>& fluid, const Tank& tank, int width) {
  double sum = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { sum += c.liquid_volume * std::cos(tank.k * c.centre.x()); });
  return 2 * sum / (tank.wavelength * width) / (tank.amplitude() * std::sin(tank.k / 2) / (tank.k / 2));
}

/// a / a_0 at every step.
template <class Real>
std::vector<double> run_wave(const Tank& tank, double reynolds, double periods) {
  const Vec3i cells(tank.wavelength, 8, static_cast<int>(tank.level) + 8);
  lbm::FluidOptions o = open_tank(cells, tank.omega / (reynolds * tank.k * tank.k), Vec3(0, 0, -tank.gravity));
  o.domain.faces.fill(lbm::FaceKind::periodic);
  o.domain.faces[4] = o.domain.faces[5] = lbm::FaceKind::open;
  o.domain.walls.add({"bottom", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::free_slip});
  lbm::Fluid<Real> fluid(o);
  fluid.fill(liquid_under(cells, [&](double x) { return tank.surface(x); }));
  std::vector<double> amplitude{measured_amplitude(fluid, tank, cells.y())};
  const auto steps = static_cast<int>(std::ceil(periods * 2 * std::numbers::pi / tank.omega)) + 1;
  for (int s = 0; s < steps; ++s) {
    fluid.step();
    amplitude.push_back(measured_amplitude(fluid, tank, cells.y()));
  }
  return amplitude;
}

double at(const std::vector<double>& series, double step) {
  const auto n = static_cast<std::size_t>(step);
  return std::lerp(series.at(n), series.at(n + 1), step - static_cast<double>(n));
}

template <class Real>
std::vector<Row> ask(const Context& context) {
  const Tank tank(context.quick ? 32 : 64);
  const double period = 2 * std::numbers::pi / tank.omega;
  const int quarters = context.quick ? 4 : kSamples - 1;
  std::vector<Row> rows;
  for (const Wave& wave : kWaves) {
    if (context.quick && wave.reynolds != 100) continue;
    const std::vector<double> series = run_wave<Real>(tank, wave.reynolds, 0.25 * quarters);
    double squares = 0;
    for (int q = 0; q <= quarters; ++q) {
      const double error = at(series, 0.25 * q * period) - wave.amplitude[static_cast<std::size_t>(q)];
      squares += error * error;
    }
    // A grid of half the cells is asked for twice the error.
    rows.push_back(at_most_row("Re " + std::to_string(static_cast<int>(wave.reynolds)) + ", RMS of a / a0",
                               std::sqrt(squares / (quarters + 1)), context.quick ? 0.06 : 0.03));
    draw_gravity_wave(context, wave.reynolds, period, series, wave.amplitude);
  }
  return rows;
}

}  // namespace

std::vector<Row> gravity_wave(const Context& context) {
  return in_precision(context, [&]<class Real>() { return ask<Real>(context); });
}

}  // namespace lahar::validate
