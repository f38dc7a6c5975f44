// Smagorinsky constants from 0 to 0.2 in a dam break that splashes, tau - 1/2 = 1e-6.
#include <cmath>
#include <string>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/dam_break.h"

namespace lahar::validate {
namespace {

/// Largest speed of a channel flow between plates under a small force, with an eddy viscosity, over that without.
std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    for (const double cs : {0.0, 0.1, 0.2}) {
      DamBreak dam = column_of_water(12);
      dam.kinematic_viscosity = 1.0 / 3 * 1e-6 * (0.23 / 12) * (kFrontSlope * std::sqrt(2 * 9.81 * 0.23)) / 0.1;
      dam.smagorinsky = cs;
      dam.steps = context.quick ? 800 : 6000;
      const DamBreakRun run = run_dam_break<Real>(dam);
      rows.push_back(at_most_row(cs > 0
                                     ? "Cs " + std::to_string(cs).substr(0, 3) + ", tau - 1/2 = 1e-6: fastest cell, lu"
                                     : "Cs 0, the same (no bar but the speed of sound)",
                                 run.fastest, cs > 0 ? 0.36 : 0.57));
    }
    return rows;
  });
}

}  // namespace

Entry dam_break_smagorinsky() {
  return {"free_surface.dam_break_smagorinsky", {"case H19 of the hard cases in a dam break", {"hard_cases.csv"}}, run};
}

}  // namespace lahar::validate
