// Surface tension: the pressure in a drop at rest (Laplace), and the swing of a drop (Lamb 1932, art. 275). No gravity.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

/// A drop x^2/a^2 + y^2/a^2 + z^2/c^2 = 1 as columns of a quarter of a cell along x and y.
std::vector<lbm::LiquidRegion> ellipsoid(const Vec3& centre, double a, double c) {
  std::vector<lbm::LiquidRegion> regions;
  constexpr double kStep = 0.25;
  const int n = static_cast<int>(std::ceil(a / kStep)) + 1;
  for (int i = -n; i < n; ++i)
    for (int k = -n; k < n; ++k) {
      const double x = (i + 0.5) * kStep, y = (k + 0.5) * kStep, r2 = (x * x + y * y) / (a * a);
      if (r2 >= 1) continue;
      const double half = c * std::sqrt(1 - r2);
      lbm::LiquidRegion column;
      column.lower = centre + Vec3(x - kStep / 2 + 1e-9, y - kStep / 2 + 1e-9, -half);
      column.upper = centre + Vec3(x + kStep / 2 - 1e-9, y + kStep / 2 - 1e-9, half);
      regions.push_back(column);
    }
  return regions;
}

lbm::FluidOptions free_box(const Vec3i& cells, double viscosity, double tension) {
  lbm::FluidOptions o = open_tank(cells, viscosity, Vec3::Zero());
  o.domain.faces.fill(lbm::FaceKind::open);
  o.surface_tension = tension;
  return o;
}

template <class Real>
void ask_laplace(const Context& context, std::vector<Row>& rows) {
  for (const double radius : context.quick ? std::vector{6.3} : std::vector{6.3, 10.3}) {
    const int n = 8 * static_cast<int>(std::ceil((2 * radius + 6) / 8));
    const double tension = 0.005;
    lbm::Fluid<Real> fluid(free_box(Vec3i::Constant(n), 0.1, tension));
    const Vec3 centre = Vec3::Constant(n / 2.0) + Vec3(0.13, 0.27, 0.41);
    fluid.fill(ellipsoid(centre, radius, radius));
    for (int s = 0; s < (context.quick ? 1500 : 4000); ++s) fluid.step();
    double pressure = 0, count = 0, volume = 0;
    Vec3 middle = Vec3::Zero();
    fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
      volume += c.liquid_volume;
      middle += c.liquid_volume * (c.centre - centre);
      if ((c.centre - centre).norm() < 0.5 * radius) pressure += c.pressure, count += 1;
    });
    const double r = std::cbrt(3 * volume / (4 * std::numbers::pi));
    const std::string label = fmt::format("drop of {:g} cells radius: ", radius);
    rows.push_back(relative_row(label + "pressure / (2 sigma / R)", pressure / count / (2 * tension / r), 1,
                                radius < 8 ? 0.10 : 0.05));
    // In the units of such flows: viscous speed sigma / (rho nu).
    rows.push_back(at_most_row(label + "parasitic current, of sigma / mu", fastest(fluid) / (tension / 0.1), 0.01));
    rows.push_back(at_most_row(label + "way that it has moved, cells", middle.norm() / volume, 0.5));
    rows.push_back(at_most_row(label + "liquid lost or won, of all", std::abs(fluid.mass_drift()),
                               sizeof(Real) == 8 ? 1e-10 : 1e-6));
  }
}

/// Times at which a series crosses its mean value.
std::vector<double> crossings(const std::vector<double>& series, double mean) {
  std::vector<double> found;
  for (std::size_t n = 1; n < series.size(); ++n) {
    const double a = series[n - 1] - mean, b = series[n] - mean;
    if ((a < 0) != (b < 0)) found.push_back(static_cast<double>(n - 1) + a / (a - b));
  }
  return found;
}

/// Second mode: omega^2 = 8 sigma / (rho R^3), damped with 5 nu / R^2 (Lamb); the damped frequency is compared.
template <class Real>
void ask_swing(const Context& context, std::vector<Row>& rows) {
  const double radius = context.quick ? 8.2 : 12.3, tension = 0.01, viscosity = 0.005;
  const int n = 8 * static_cast<int>(std::ceil((2.4 * radius + 6) / 8));
  lbm::Fluid<Real> fluid(free_box(Vec3i::Constant(n), viscosity, tension));
  const Vec3 centre = Vec3::Constant(n / 2.0) + Vec3(0.13, 0.27, 0.41);
  const double stretch = 1.1;
  fluid.fill(ellipsoid(centre, radius / std::sqrt(stretch), radius * stretch));
  double volume = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { volume += c.liquid_volume; });
  const double r = std::cbrt(3 * volume / (4 * std::numbers::pi));
  const double natural = std::sqrt(8 * tension / (r * r * r)), damping = 5 * viscosity / (r * r);
  const double omega = std::sqrt(natural * natural - damping * damping);
  const auto steps = static_cast<int>(2.3 * 2 * std::numbers::pi / omega);
  std::vector<double> shape;
  for (int s = 0; s < steps; ++s) {
    double xx = 0, zz = 0;
    fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
      const Vec3 p = c.centre - centre;
      xx += c.liquid_volume * 0.5 * (p.x() * p.x() + p.y() * p.y()), zz += c.liquid_volume * p.z() * p.z();
    });
    shape.push_back(zz / xx - 1);
    fluid.step();
  }
  const std::vector<double> times = crossings(shape, 0);
  const double half_periods = static_cast<double>(times.size()) - 1;
  const double found = times.size() < 2 ? 0 : std::numbers::pi * half_periods / (times.back() - times.front());
  const std::string label = fmt::format("swing of a drop, {:g} cells radius: ", radius);
  rows.push_back(at_least_row(label + "swings seen", half_periods, 3));
  rows.push_back(relative_row(label + "frequency / Lamb's", found / omega, 1, context.quick ? 0.10 : 0.05));
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    ask_laplace<Real>(context, rows);
    ask_swing<Real>(context, rows);
    return rows;
  });
}

}  // namespace

Entry laplace_drop() { return {"free_surface.laplace_drop", {"Laplace; Lamb 1932, art. 275"}, run}; }

}  // namespace lahar::validate
