// Smagorinsky constants from 0 to 0.2 in a dam break that splashes, tau - 1/2 = 1e-6.
#include <cmath>
#include <string>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/dam_break.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

/// Largest speed of a channel flow between plates under a small force, with an eddy viscosity, over that without.
template <class Real>
double poiseuille_ratio(double smagorinsky) {
  const auto peak = [](double cs) {
    lbm::FluidOptions o = open_tank(Vec3i(8, 8, 16), 0.05, Vec3(2e-5, 0, 0));
    o.domain.faces.fill(lbm::FaceKind::periodic);
    o.domain.faces[4] = o.domain.faces[5] = lbm::FaceKind::closed;
    o.smagorinsky = cs;
    lbm::Fluid<Real> fluid(o);
    fluid.fill_everything([](const Vec3&) { return Vec3::Zero().eval(); }, [](const Vec3&) { return 0.0; });
    for (int s = 0; s < 6000; ++s) fluid.step();
    return fastest(fluid);
  };
  return peak(smagorinsky) / peak(0);
}

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
    rows.push_back(relative_row("Poiseuille flow with Cs 0.2 over that without", poiseuille_ratio<Real>(0.2), 1, 0.01));
    return rows;
  });
}

}  // namespace

Entry dam_break_smagorinsky() {
  return {"free_surface.dam_break_smagorinsky", {"case H19 of the hard cases in a dam break", {"hard_cases.csv"}}, run};
}

}  // namespace lahar::validate
