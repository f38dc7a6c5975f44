// A standing wave of small amplitude on deep water, from rest, against Prosperetti 1981 (Physics of Fluids 24, 1217:
// the initial-value problem with viscosity). The amplitude of 0.01 wavelengths is less than a cell: a surface that is
// known only to the cell does not feel it.
#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/surface_charts.h"
#include "cases/validate/free_surface/surface_flows.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {
namespace {

constexpr int kQuarters = 16;  // of a period, at each of which the amplitude is compared

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
  const int quarters = context.quick ? 4 : kQuarters;
  const ReferenceTable prosperetti = reference("gravity_wave_prosperetti.csv");
  std::vector<Row> rows;
  for (const int reynolds : {10, 100, 1000, 10000}) {  // omega_0 / (nu k^2)
    if (context.quick && reynolds != 100) continue;
    const std::vector<double> series = run_wave<Real>(tank, reynolds, 0.25 * quarters);
    std::vector<double> amplitude = prosperetti.where("Re", std::to_string(reynolds)).numbers("a_over_a0");
    amplitude.resize(kQuarters + 1);
    double squares = 0;
    for (int q = 0; q <= quarters; ++q) {
      const double error = at(series, 0.25 * q * period) - amplitude[static_cast<std::size_t>(q)];
      squares += error * error;
    }
    // A grid of half the cells is asked for twice the error.
    rows.push_back(at_most_row("Re " + std::to_string(reynolds) + ", RMS of a / a0",
                               std::sqrt(squares / (quarters + 1)), context.quick ? 0.06 : 0.03));
    draw_gravity_wave(context, reynolds, period, series, amplitude);
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
