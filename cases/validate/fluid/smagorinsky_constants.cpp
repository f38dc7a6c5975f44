// Case H19 of reference/hard_cases.csv: Smagorinsky constants from 0 to 0.2 at tau - 1/2 = 1e-6. Stable with Cs >= 0.1
// (and, tighter, with none); what is laminar or at rest is changed by less than 1 %.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/periodic_flows.h"
#include "core/worst.h"

namespace lahar::validate {

namespace {

constexpr double kViscosity = 1e-6 / 3;  // lu: tau - 1/2 = 1e-6
constexpr std::array<double, 5> kConstants = {0, 0.05, 0.1, 0.16, 0.2};

/// A closed box full of water at rest: largest pressure difference to rho g h, as a share of that at the bottom, and
/// largest speed, as a share of sqrt(g h).
struct Rest {
  double pressure = 0, speed = 0;
};

Rest rest_of(double smagorinsky, int steps) {
  const int n = 14;
  const double g = 1e-5;
  lbm::FluidOptions o = lattice_box(Vec3i::Constant(n), kViscosity);
  o.domain.faces.fill(lbm::FaceKind::closed);
  o.gravity = Vec3(0, 0, -g);
  o.smagorinsky = smagorinsky;
  lbm::Fluid<double> fluid(o);
  fluid.fill_everything(at_rest, [&](const Vec3& p) { return 3 * g * (n / 2.0 - p.z()); });
  advance(fluid, steps);
  Rest rest;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    keep_worst(rest.pressure, std::abs(c.pressure - g * (n / 2.0 - c.centre.z())) / (g * n));
    keep_worst(rest.speed, c.velocity.norm() / std::sqrt(g * n));
  });
  return rest;
}

/// Peak of a laminar plane Poiseuille flow at Re = u_max H / nu = 10, as a share of the exact one.
double poiseuille_peak(double smagorinsky, int cells) {
  const double viscosity = 0.06, height = cells, peak = 10 * viscosity / height;
  lbm::FluidOptions o = lattice_box({8, 8, cells}, viscosity);
  o.domain.faces[4] = o.domain.faces[5] = lbm::FaceKind::closed;
  o.gravity = Vec3(8 * viscosity * peak / (height * height), 0, 0);
  o.smagorinsky = smagorinsky;
  lbm::Fluid<double> fluid(o);
  fluid.fill_everything(at_rest, no_pressure);
  advance(fluid, diffusive_steps(1.5, cells, viscosity));
  double highest = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { highest = std::max(highest, c.velocity.x()); });
  return highest / peak;
}

/// By how much of itself the eddy viscosity lowers that peak: nu g + Cs^2 g^2 = G z for the shear rate g at z from the
/// middle, integrated up to the wall.
double lost_peak(double smagorinsky, int cells) {
  const double viscosity = 0.06, half = 0.5 * cells, force = 80 * viscosity * viscosity / std::pow(cells, 3);
  const double c = smagorinsky * smagorinsky, a = viscosity * viscosity, b = 4 * c * force;
  const double roots = 2 / (3 * b) * (std::pow(a + b * half, 1.5) - std::pow(a, 1.5));
  const double peak = (roots - viscosity * half) / (2 * c), laminar = force * half * half / (2 * viscosity);
  return 1 - peak / laminar;
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  const int cells = context.quick ? 16 : 30;
  const double laminar = poiseuille_peak(0, cells);
  for (const double cs : kConstants) {
    for (const PeriodicFlow flow : {PeriodicFlow::shear_layer, PeriodicFlow::vortex}) {
      const bool vortex = flow == PeriodicFlow::vortex;
      if (context.quick && vortex) continue;
      const Stability s = run_periodic({.flow = flow,
                                        .viscosity = kViscosity,
                                        .mach = 0.2,
                                        .smagorinsky = cs,
                                        .cells = vortex || context.quick ? 32 : 64},
                                       Precision::float32);
      rows.push_back(
          at_most_row(fmt::format("Cs {}: energy of the {}", cs, vortex ? "vortex" : "layer"), s.largest, 1.001));
    }
    const Rest rest = rest_of(cs, context.quick ? 1000 : 20000);
    rows.push_back(at_most_row(fmt::format("Cs {}: pressure at rest less rho g h", cs), rest.pressure,
                               context.quick ? 2e-3 : 1e-4));
    rows.push_back(at_most_row(fmt::format("Cs {}: speed at rest / sqrt(g h)", cs), rest.speed, 1e-3));
    if (cs > 0)
      rows.push_back(relative_row(fmt::format("Cs {}: lost of the peak of Poiseuille flow, Re 10, {} cells", cs, cells),
                                  1 - poiseuille_peak(cs, cells) / laminar, lost_peak(cs, cells), 0.01));
  }
  return rows;
}

}  // namespace

Entry smagorinsky_constants() {
  return {"fluid.smagorinsky_constants",
          {"case H19 of the hard cases: LES at vanishing viscosity", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate
