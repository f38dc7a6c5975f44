// Water at rest stays at rest, with the pressure of its depth: level between cells, and a tank that stands at 35
// degrees to the lattice, whose surface then cuts the cells in every way. Case H3 asks the same of water.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/fluid/surface_entries.h"
#include "cases/validate/fluid/surface_flows.h"

namespace lahar::validate {
namespace {

struct Rest {
  Vec3i cells;
  double angle = 0;  ///< rad, between gravity and -z, in the xz plane
  double level = 0;  ///< of the surface in the middle of the tank, cells
  double viscosity = 0.01;
  double wave_speed = 0.02;  ///< sqrt(g H), lu: the liquid is compressed by 0.1 % at the bottom
  int steps = 100000;

  [[nodiscard]] double gravity() const { return wave_speed * wave_speed / level; }
  [[nodiscard]] Vec3 acceleration() const { return gravity() * Vec3(std::sin(angle), 0, -std::cos(angle)); }
  [[nodiscard]] double surface(double x) const { return level + std::tan(angle) * (x - 0.5 * cells.x()); }
  /// Hydrostatic pressure, lu, where the surface is the plane through the middle of the tank.
  [[nodiscard]] double pressure(const Vec3& p) const { return gravity() * std::cos(angle) * (surface(p.x()) - p.z()); }
};

struct Found {
  double speed = 0;           ///< fastest cell in the last hundredth of the run, lu
  double pressure_error = 0;  ///< largest in liquid below the surface layer, of rho g H
  double drift = 0;
};

template <class Real>
Found run_rest(const Rest& rest) {
  lbm::FluidOptions o = open_tank(rest.cells, rest.viscosity, rest.acceleration());
  o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
  lbm::Fluid<Real> fluid(o);
  fluid.fill(rest.angle == 0 ? liquid_under(rest.cells, [&](double) { return rest.level; })
                             : liquid_under_slope(rest.cells, [&](double x) { return rest.surface(x); }));
  Found found;
  for (int s = 1; s <= rest.steps; ++s) {
    fluid.step();
    if (s > rest.steps - rest.steps / 100 && s % 10 == 0) found.speed = std::max(found.speed, fastest(fluid));
  }
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    if (rest.pressure(c.centre) < 2 * rest.gravity()) return;  // not the layer of interface cells
    const double error = std::abs(c.pressure - rest.pressure(c.centre)) / (rest.gravity() * rest.level);
    found.pressure_error = std::max(found.pressure_error, error);
  });
  found.drift = fluid.mass_drift();
  return found;
}

/// sqrt(g H), in whose units the bar for float is given (hard_cases.csv, H3); 1e-6 lu in double.
template <class Real>
double speed_bar(const Rest& rest) {
  return sizeof(Real) == 8 ? 1e-6 : 1e-4 * rest.wave_speed;
}

template <class Real>
std::vector<Row> ask(const Rest& rest, const std::string& label) {
  const Found found = run_rest<Real>(rest);
  if (rest.steps < 100000 && rest.viscosity < 1e-3)  // swings of the start need the full time to die down
    return {at_most_row(label + "liquid lost or won, of all", std::abs(found.drift), sizeof(Real) == 8 ? 1e-10 : 1e-6)};
  return {at_most_row(label + "max speed, lu", found.speed, speed_bar<Real>(rest)),
          at_most_row(label + "pressure error, of rho g H", found.pressure_error, 1e-3),
          at_most_row(label + "liquid lost or won, of all", std::abs(found.drift), sizeof(Real) == 8 ? 1e-10 : 1e-6)};
}

Rest level_tank(const Context& context) {
  return {.cells = Vec3i(16, 8, 40), .level = 32.5, .steps = context.quick ? 10000 : 100000};
}

Rest tilted_tank(const Context& context) {
  return {.cells = Vec3i(32, 8, 48),
          .angle = 35 * std::numbers::pi / 180,
          .level = 24.3,
          .steps = context.quick ? 10000 : 100000};
}

}  // namespace

std::vector<Row> hydrostatic(const Context& context) {
  return in_precision(context, [&]<class Real>() { return ask<Real>(level_tank(context), ""); });
}

std::vector<Row> hydrostatic_tilted(const Context& context) {
  return in_precision(context, [&]<class Real>() { return ask<Real>(tilted_tank(context), ""); });
}

/// Water in a tank 1 m deep: 2e-7 lu at these sizes.
std::vector<Row> hard_h3(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    Rest level = level_tank(context), tilted = tilted_tank(context);
    level.viscosity = tilted.viscosity = 2e-7;
    std::vector<Row> rows = ask<Real>(level, "level, fill 0.5: ");
    for (Row& r : ask<Real>(tilted, "35 degrees: ")) rows.push_back(r);
    return rows;
  });
}

}  // namespace lahar::validate
