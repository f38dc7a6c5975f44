// A dam break of water in cells of 10 mm, tau - 1/2 of 1e-5 and less.
#include <cmath>
#include <string>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/dam_break.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

template <class Real>
std::vector<Row> ask(const Context& context, double viscosity, const std::string& label) {
  DamBreak dam = column_of_water(23);  // 10 mm
  dam.kinematic_viscosity = viscosity;
  dam.steps = context.quick ? 1500 : 20000;
  const DamBreakRun run = run_dam_break<Real>(dam);
  const FrontErrors e = compare_front(run);
  return {at_least_row(label + "steps without NaN", static_cast<double>(run.steps), dam.steps),
          at_most_row(label + "fastest cell, lu", run.fastest, 0.3),
          at_most_row(label + "mass drift", run.drift, sizeof(Real) == 8 ? 1e-10 : 1e-6),
          at_most_row(label + "RMS of the front", e.rms, 0.05),
          at_most_row(label + "the same after the best shift in T (our bar)", e.shifted_rms, 0.05),
          at_most_row(label + "rise of the energy, of the initial one", run.energy_rise, 0.005)};
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows = ask<Real>(context, 1e-6, "water: ");
    // tau - 1/2 = 1e-6: nu_lu = 3.3e-7, with the time step of the run above
    const double dx = 0.01, dt = 0.1 * dx / (kFrontSlope * std::sqrt(2 * 9.81 * 0.23));
    for (const Row& r : ask<Real>(context, 1e-6 / 3 * dx * dx / dt, "tau - 1/2 = 1e-6: ")) rows.push_back(r);
    return rows;
  });
}

}  // namespace

Entry dam_break_low_viscosity() {
  return {"free_surface.dam_break_low_viscosity",
          {"case H1 of the hard cases; front of Martin & Moyce 1952", {"hard_cases.csv", "martin_moyce1952.csv"}},
          run};
}

}  // namespace lahar::validate
