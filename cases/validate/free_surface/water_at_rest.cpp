#include "cases/validate/free_surface/water_at_rest.h"

#include <algorithm>
#include <numbers>

#include "cases/validate/free_surface/surface_flows.h"
#include "core/worst.h"

namespace lahar::validate {
namespace {

struct Found {
  double speed = 0;           ///< fastest cell in the last hundredth of the run, lu
  double pressure_error = 0;  ///< largest in liquid below the surface layer, of rho g H
  double drift = 0;
};

template <class Real>
Found run_rest(const WaterAtRest& rest) {
  lbm::FluidOptions o = open_tank(rest.cells, rest.viscosity, rest.acceleration());
  o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
  lbm::Fluid<Real> fluid(o);
  fluid.fill(rest.angle == 0 ? liquid_under(rest.cells, [&](double) { return rest.level; })
                             : liquid_under_slope(rest.cells, [&](double x) { return rest.surface(x); }));
  Found found;
  for (int s = 1; s <= rest.steps; ++s) {
    fluid.step();
    if (s > rest.steps - rest.steps / 100 && s % 10 == 0) keep_worst(found.speed, fastest(fluid));
  }
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    if (rest.pressure(c.centre) < 2 * rest.gravity()) return;  // not the layer of interface cells
    const double error = std::abs(c.pressure - rest.pressure(c.centre)) / (rest.gravity() * rest.level);
    keep_worst(found.pressure_error, error);
  });
  found.drift = fluid.mass_drift();
  return found;
}

/// sqrt(g H), in whose units the bar for float is given (hard_cases.csv, H3); 1e-6 lu in double.
template <class Real>
double speed_bar(const WaterAtRest& rest) {
  return sizeof(Real) == 8 ? 1e-6 : 1e-4 * rest.wave_speed;
}

template <class Real>
std::vector<Row> ask(const WaterAtRest& rest, const std::string& label) {
  const Found found = run_rest<Real>(rest);
  if (rest.steps < 100000 && rest.viscosity < 1e-3)  // swings of the start need the full time to die down
    return {at_most_row(label + "liquid lost or won, of all", std::abs(found.drift), sizeof(Real) == 8 ? 1e-10 : 1e-6)};
  return {at_most_row(label + "max speed, lu", found.speed, speed_bar<Real>(rest)),
          at_most_row(label + "pressure error, of rho g H", found.pressure_error, 1e-3),
          at_most_row(label + "liquid lost or won, of all", std::abs(found.drift), sizeof(Real) == 8 ? 1e-10 : 1e-6)};
}

}  // namespace

WaterAtRest level_tank(const Context& context) {
  return {.cells = Vec3i(16, 8, 40), .level = 32.5, .steps = context.quick ? 10000 : 100000};
}

WaterAtRest tilted_tank(const Context& context) {
  return {.cells = Vec3i(32, 8, 48),
          .angle = 35 * std::numbers::pi / 180,
          .level = 24.3,
          .steps = context.quick ? 10000 : 100000};
}

std::vector<Row> rows_at_rest(const WaterAtRest& rest, const std::string& label, const Context& context) {
  return in_precision(context, [&]<class Real>() { return ask<Real>(rest, label); });
}

}  // namespace lahar::validate
