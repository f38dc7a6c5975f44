// A time step that changes during the run: flows do not feel the change (a decaying vortex, water at rest), and a dam
// break that starts with a step three times too short or too long ends as that with the right one.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"
#include "cases/validate/free_surface/dam_break.h"
#include "cases/validate/free_surface/surface_flows.h"
#include "core/check.h"
#include "core/worst.h"

namespace lahar::validate {
namespace {

using lbm::CollisionOperator;

/// Two-dimensional Taylor-Green vortex: u = U sin kx cos ky, decays with exp(-2 nu k^2 t).
struct Vortex {
  int cells = 32;
  double viscosity = 0.01;  ///< lu of the first step
  double speed = 0.02;
  CollisionOperator collision = lbm::CentralMoments{};
  double ratio = 1;  ///< new / old step
  [[nodiscard]] double k() const { return 2 * std::numbers::pi / cells; }
  [[nodiscard]] double rate() const { return 2 * viscosity * k() * k(); }
};

struct Decay {
  double rate = 0;               ///< of the velocity, over the change, as a fraction of 2 nu k^2
  std::vector<double> pressure;  ///< of all cells, a little after the change
};

constexpr double kBefore = 60, kAfter = 240, kLook = 20;  // steps of the first length

Decay run_vortex(const Vortex& v) {
  lbm::FluidOptions o = lattice_box({v.cells, v.cells, 8}, v.viscosity);
  o.collision = v.collision;
  lbm::Fluid<double> fluid(o);
  const double k = v.k(), u = v.speed;
  fluid.fill_everything(
      [=](const Vec3& p) {
        return Vec3(u * std::sin(k * p.x()) * std::cos(k * p.y()), -u * std::cos(k * p.x()) * std::sin(k * p.y()), 0);
      },
      [=](const Vec3& p) { return 0.75 * u * u * (std::cos(2 * k * p.x()) + std::cos(2 * k * p.y())); },
      lbm::Start::with_stress);
  advance(fluid, static_cast<int>(kBefore));
  const double start = kinetic_energy(fluid);
  fluid.set_time_step(v.ratio);
  Decay found;
  while (fluid.time() < kBefore + kAfter - 1e-9) {
    fluid.step();
    if (found.pressure.empty() && fluid.time() > kBefore + kLook - 1e-9)
      fluid.for_each_wet_cell([&](const lbm::WetCell& c) { found.pressure.push_back(c.pressure); });
  }
  found.rate = -0.5 * std::log(kinetic_energy(fluid) / start) / (fluid.time() - kBefore) / v.rate();
  return found;
}

/// Largest difference of pressure from the run that was left alone, of rho U^2 / 2.
double bang(const Decay& changed, const Decay& alone, double speed) {
  double most = 0;
  for (std::size_t n = 0; n < alone.pressure.size(); ++n)
    keep_worst(most, std::abs(changed.pressure[n] - alone.pressure[n]));
  return most / (0.5 * speed * speed);
}

void ask_vortex(const Context& context, std::vector<Row>& rows) {
  for (const CollisionOperator collision : kOperators) {
    const bool first = collision == kOperators.front();
    if (context.quick && !first) continue;
    const Decay alone = run_vortex({.collision = collision});
    const std::vector<double> ratios = context.quick ? std::vector{0.5, 1.25}
                                       : first       ? std::vector{0.25, 0.5, 0.8, 1.25, 2.0, 4.0}
                                                     : std::vector{0.5, 2.0};
    for (const double ratio : ratios) {
      const Decay changed = run_vortex({.collision = collision, .ratio = ratio});
      const std::string label = fmt::format("vortex, {}, step x {:g}: ", name(collision), ratio);
      rows.push_back(relative_row(label + "decay rate / 2 nu k^2", changed.rate, 1, 0.005));
      rows.push_back(at_most_row(label + "pressure jump, of rho U^2 / 2", bang(changed, alone, Vortex().speed), 0.05));
    }
  }
}

/// A tank at rest whose step goes up and down. Shallow and viscous, so that the sound of the start has died down
/// before.
template <class Real>
void ask_rest(const Context& context, std::vector<Row>& rows) {
  const Vec3i cells(16, 8, 16);
  const double level = 12.4, gravity = 0.02 * 0.02 / level;
  lbm::FluidOptions o = open_tank(cells, 0.05, Vec3(0, 0, -gravity));
  o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
  lbm::Fluid<Real> fluid(o);
  fluid.fill(liquid_under(cells, [&](double) { return level; }));
  const int rest = context.quick ? 8000 : 20000;
  advance(fluid, rest);
  double speed = 0, jump = 0;
  for (const double ratio : {0.8, 0.5, 2.0, 1.25, 1.25, 2.0, 0.8, 0.5}) {
    const double before = fastest(fluid);
    fluid.set_time_step(ratio * fluid.units().time_step);
    for (int s = 0; s < 200; ++s) {
      fluid.step();
      keep_worst(jump, fastest(fluid) - before);
    }
    keep_worst(speed, fastest(fluid));
  }
  double error = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    const double exact = gravity * (level - c.centre.z());
    if (exact > 2 * gravity) keep_worst(error, std::abs(c.pressure - exact) / (gravity * level));
  });
  const bool exact = sizeof(Real) == 8;
  rows.push_back(at_most_row("tank at rest, 8 changes: speed, lu of the first step", speed, exact ? 1e-6 : 2e-6));
  rows.push_back(at_most_row("the same: speed that came with a change", jump, exact ? 1e-6 : 2e-6));
  rows.push_back(at_most_row("the same: pressure error, of rho g H", error, 1e-3));
  rows.push_back(
      at_most_row("the same: liquid lost or won, of all", std::abs(fluid.mass_drift()), exact ? 1e-10 : 1e-6));
}

/// Column of 0.23 m x 0.46 m, as in dam_break_low_viscosity.
DamBreak water_column(const Context& context, double lattice_velocity, bool adaptive) {
  DamBreak dam;
  dam.column = 0.23;
  dam.width = context.quick ? 12 : 23;
  dam.lattice_velocity = lattice_velocity;
  dam.adaptive = adaptive;
  return dam;
}

/// RMS of the difference of two fronts, of the front.
double front_difference(const DamBreakRun& a, const DamBreakRun& b) {
  double squares = 0;
  int n = 0;
  for (double t = 0.5; t < 3.3; t += 0.05, ++n) squares += std::pow(a.front_at(t) / b.front_at(t) - 1, 2);
  return std::sqrt(squares / n);
}

template <class Real>
void ask_dam(const Context& context, std::vector<Row>& rows) {
  const double ledger = sizeof(Real) == 8 ? 1e-10 : 1e-6;
  const auto run = [&](double lattice_velocity, bool adaptive) {
    return run_dam_break<Real>(water_column(context, lattice_velocity, adaptive));
  };
  const DamBreakRun right = run(0.1, false);
  // The column, twice as high as wide, stands under its own weight at the start: mean compression 3/2 g H = 0.862 v^2
  // with v = 1.319 sqrt(2 g a), of the first step or of the right one.
  const auto ask = [&](const std::string& label, const DamBreakRun& found, double largest_velocity) {
    rows.push_back(
        at_most_row(label + "front against that of the right step, RMS", front_difference(found, right), 0.02));
    rows.push_back(at_most_row(label + "liquid lost or won, of all", found.drift, ledger));
    rows.push_back(at_most_row(label + "mass booked for compression, of all", std::abs(found.rescaled),
                               1.05 * 0.862 * largest_velocity * largest_velocity));
    rows.push_back(at_least_row(label + "changes of the step", static_cast<double>(found.changes), 1));
  };
  const DamBreakRun from_short = run(0.1 / 3, true);
  ask("dam break, first step a third: ", from_short, 0.1);
  rows.push_back(at_most_row("the same: steps / steps without adapting",
                             static_cast<double>(from_short.steps) / (3 * static_cast<double>(right.steps)), 0.6));
  const DamBreakRun from_long = run(0.3, true);
  ask("dam break, first step three times: ", from_long, 0.3);
  rows.push_back(at_most_row("the same: fastest cell, lu", from_long.fastest, 0.3));
}

/// Whether the watchdog stops a dam break.
template <class Real>
bool is_stopped(const DamBreak& dam) {
  try {
    run_dam_break<Real>(dam);
  } catch (const NumericalFailure&) {
    return true;
  }
  return false;
}

/// With a step that nothing shortens the same guess ends at the watchdog.
template <class Real>
void ask_wrong_guess(const Context& context, std::vector<Row>& rows) {
  const double guess = 0.6;  // six times
  rows.push_back(absolute_row("first step six times, fixed: stopped (1 = yes)",
                              is_stopped<Real>(water_column(context, guess, false)), 1, 0));
  rows.push_back(absolute_row("first step six times, adaptive: stopped (1 = yes)",
                              is_stopped<Real>(water_column(context, guess, true)), 0, 0));
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    ask_vortex(context, rows);
    ask_rest<Real>(context, rows);
    ask_dam<Real>(context, rows);
    ask_wrong_guess<Real>(context, rows);
    return rows;
  });
}

}  // namespace

Entry adaptive_time_step() {
  return {"free_surface.adaptive_time_step", {"the same flows with the right step throughout"}, run};
}

}  // namespace lahar::validate
