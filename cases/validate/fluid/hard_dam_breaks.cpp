// Hard cases H1, H2 and H19: dam breaks of water, tau - 1/2 of 1e-5 and less.
#include <cmath>

#include "cases/validate/fluid/dam_break.h"
#include "cases/validate/fluid/surface_entries.h"
#include "cases/validate/fluid/surface_flows.h"

namespace lahar::validate {
namespace {

/// Column of 0.23 m x 0.46 m: a fall from its top gives 3 m/s.
DamBreak water_column(int cells) {
  DamBreak dam;
  dam.column = 0.23;
  dam.width = cells;
  return dam;
}

template <class Real>
std::vector<Row> h1(const Context& context, double viscosity, const std::string& label) {
  DamBreak dam = water_column(23);  // 10 mm
  dam.kinematic_viscosity = viscosity;
  dam.steps = context.quick ? 1500 : 20000;
  const DamBreakRun run = run_dam_break<Real>(dam);
  const FrontErrors e = compare_front(run);
  return {at_least_row(label + "steps without NaN", static_cast<double>(run.steps), dam.steps),
          at_most_row(label + "fastest cell, lu", run.fastest, 0.3),
          at_most_row(label + "mass drift", run.drift, sizeof(Real) == 8 ? 1e-6 : 1e-4),
          at_most_row(label + "RMS of the front", e.rms, 0.05),
          at_most_row(label + "the same after the best shift in T (no bar)", e.shifted_rms, 1),
          at_most_row(label + "rise of the energy, of the initial one", run.energy_rise, 0.005)};
}

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

}  // namespace

std::vector<Row> hard_h1(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows = h1<Real>(context, 1e-6, "water: ");
    // tau - 1/2 = 1e-6: nu_lu = 3.3e-7, with the time step of the run above
    const double dx = 0.01, dt = 0.1 * dx / (kFrontSlope * std::sqrt(2 * 9.81 * 0.23));
    for (const Row& r : h1<Real>(context, 1e-6 / 3 * dx * dx / dt, "tau - 1/2 = 1e-6: ")) rows.push_back(r);
    return rows;
  });
}

std::vector<Row> hard_h2(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    const auto arrival = [](int cells, double lattice_velocity) {
      DamBreak dam = water_column(cells);
      dam.lattice_velocity = lattice_velocity;
      return run_dam_break<Real>(dam).time_at(3.5);
    };
    const double coarse = arrival(12, 0.1), middle = arrival(23, 0.1);
    std::vector<Row> rows{relative_row("time to Z = 3.5 at 20 mm against 10 mm (no bar)", coarse, middle, 1.0)};
    if (!context.quick)
      rows.push_back(relative_row("time to Z = 3.5 at 10 mm against 5 mm", middle, arrival(46, 0.1), 0.03));
    rows.push_back(relative_row("at a lattice velocity of 0.1 against 0.05", middle, arrival(23, 0.05), 0.03));
    rows.push_back(relative_row("at a lattice velocity of 0.2 against 0.1", arrival(23, 0.2), middle, 0.03));
    return rows;
  });
}

std::vector<Row> hard_h19_splash(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    for (const double cs : {0.0, 0.1, 0.2}) {
      DamBreak dam = water_column(12);
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

}  // namespace lahar::validate
