// Smagorinsky constants from 0 to 0.2 in a dam break that splashes, tau - 1/2 = 1e-6. The case asks for stability with
// an eddy viscosity; without one the same bars hold. The largest speed is that of case H1.
#include <fmt/format.h>

#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/dam_break.h"

namespace lahar::validate {
namespace {

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    for (const double cs : {0.0, 0.1, 0.2}) {
      DamBreak dam = column_of_water(12);
      dam.kinematic_viscosity = 1.0 / 3 * 1e-6 * (0.23 / 12) * (kFrontSlope * std::sqrt(2 * 9.81 * 0.23)) / 0.1;
      dam.smagorinsky = cs;
      dam.steps = context.quick ? 800 : 6000;
      const DamBreakRun run = run_dam_break<Real>(dam);
      const std::string what = fmt::format("Cs {:g}, tau - 1/2 = 1e-6: ", cs);
      rows.push_back(at_most_row(what + "fastest cell, lu", run.fastest, 0.3));
      rows.push_back(at_most_row(what + "most cells in a step that the velocity limiter slowed",
                                 static_cast<double>(run.limited_cells), 0));
    }
    return rows;
  });
}

}  // namespace

Entry dam_break_smagorinsky() {
  return {"free_surface.dam_break_smagorinsky", {"case H19 of the hard cases in a dam break", {"hard_cases.csv"}}, run};
}

}  // namespace lahar::validate
