// A light sphere floats: how deep, and how fast it heaves.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/closed_forms.h"
#include "cases/validate/grains_in_fluid/sphere_tanks.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {
namespace {

/// Period without the water's inertia: the waterline's area gives the spring.
double dry_period(double s, double radius, double gravity) {
  const double off = 2 * immersed_share(s) - 1, waterline = radius * radius * (1 - off * off);
  return 2 * std::numbers::pi * std::sqrt(s * 4.0 / 3.0 * std::pow(radius, 3) / (gravity * waterline));
}

/// Twice the time from the release at rest to the first turn over the dry period, in a round tank of the same area and
/// depth. At a density ratio of 0.5 in a tank of 16 diameters the program that computed the table has 1.207; an added
/// mass of 0.43 of the displaced (Hulme 1982, J. Fluid Mech. 121, 443, at the frequency of this heave) gives 1.196. The
/// added mass of a sphere that lies higher in the water is a larger share of its mass: 0.79, 0.51, 0.37 of it at high
/// frequency.
std::vector<std::pair<double, double>> heave_over_dry() {
  return reference("floating_sphere_heave.csv").points("density_ratio", "period_over_dry");
}

/// A sphere of this density in a tank whose size goes with it, at rest a tenth of a diameter too high.
SphereTank tank_for(double s, double diameter, double viscosity) {
  const int w = static_cast<int>(4 * diameter);
  SphereTank t;
  t.cells = Vec3i(w, w, w);
  t.depth = 2 * diameter + 0.4;
  t.diameter = diameter;
  t.density = s;
  t.viscosity = viscosity;
  const double area = static_cast<double>(w) * w, volume = std::numbers::pi / 6 * std::pow(diameter, 3);
  const double level = t.depth + s * volume / area, deep = immersed_share(s) * diameter;
  t.place = Vec3(w / 2 + 0.2, w / 2 - 0.1, level - deep + diameter / 2 + 0.1 * diameter);
  t.depth = level;  // the sphere's place is part of the fill
  return t;
}

/// How deep the sphere lies, diameters, for a mean height of its centre.
template <class Real>
double depth_at(double height, const SphereTank& t, coupling::CoupledStep<Real>& step) {
  const double surface = filled_volume(*step.fluid()) / (static_cast<double>(t.cells.x()) * t.cells.y());
  return (surface - height) / t.diameter + 0.5;
}

/// Is followed for some periods of water all but without viscosity: the reference has none, and 1e-3 would add a
/// boundary layer of a tenth of the mass.
template <class Real>
void float_one(std::vector<Row>& rows, double s, double over_dry, double diameter, const Context& context) {
  const SphereTank t = tank_for(s, diameter, 1e-5);
  const double period = over_dry * dry_period(s, diameter / 2, t.gravity);
  const auto tank = make_tank<Real>(t);
  auto& step = *tank;
  const int steps = static_cast<int>((context.quick ? 1.5 : 4.5) * period);
  const auto height = [&] { return step.solids()->particles().position.z[0]; };
  double lowest = 1e300, late = 0;
  int turn = 0, samples = 0;
  for (int k = 0; k < steps; ++k) {
    step.advance();
    // Half a period: from the start at rest to the first turn at the bottom.
    if (height() < lowest && k < static_cast<int>(0.9 * period)) lowest = height(), turn = k + 1;
    if (k >= steps - static_cast<int>(period)) late += height(), ++samples;
  }
  const std::string what = fmt::format("density ratio {:g}, D {:g} cells", s, diameter);
  if (!context.quick)
    rows.push_back(absolute_row(what + ": immersion depth, diameters", depth_at(late / samples, t, step),
                                immersed_share(s), 0.02));
  rows.push_back(relative_row(what + ": heave period", 2.0 * turn, period, 0.10));
  add_ledgers(rows, what, step);
}

/// Viscosity must not change how deep it lies. Heaves that it damps are gone after some periods.
template <class Real>
void float_in_viscous(std::vector<Row>& rows, double s, double over_dry, double viscosity, int periods) {
  const SphereTank t = tank_for(s, 8, viscosity);
  const double period = over_dry * dry_period(s, t.diameter / 2, t.gravity);
  const auto tank = make_tank<Real>(t);
  const int steps = static_cast<int>(periods * period), averaged = static_cast<int>(period);
  double late = 0;
  for (int k = 0; k < steps; ++k) {
    tank->advance();
    if (k >= steps - averaged) late += tank->solids()->particles().position.z[0] / averaged;
  }
  rows.push_back(
      absolute_row(fmt::format("density ratio {:g}, viscosity {:g} lu: immersion depth, diameters", s, viscosity),
                   depth_at(late, t, *tank), immersed_share(s), 0.02));
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    const auto heave = heave_over_dry();
    for (const auto& [s, over_dry] : heave)
      if (!context.quick || s == 0.5) float_one<Real>(rows, s, over_dry, 8, context);
    if (context.quick)
      float_in_viscous<Real>(rows, heave.front().first, heave.front().second, 3e-3, 2);
    else
      for (const double viscosity : {1e-3, 3e-3, 1e-2, 3e-2})
        for (const auto& [s, over_dry] : heave) float_in_viscous<Real>(rows, s, over_dry, viscosity, 5);
    return rows;
  });
}

}  // namespace

Entry floating_sphere() {
  return {"grains_in_fluid.floating_sphere",
          {"3 x^2 - 2 x^3 = s; heave by linear potential flow", {"floating_sphere.csv", "floating_sphere_heave.csv"}},
          run};
}

}  // namespace lahar::validate
