// A vessel on a slope of 35 degrees is overtopped, drains, and is filled again.
#include <algorithm>
#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/slope.h"
#include "cases/validate/free_surface/surface_flows.h"
#include "core/worst.h"

namespace lahar::validate {
namespace {

constexpr int kFilling = 500;  ///< steps after which both fillings are looked at: over the wall, not yet drained

/// Water behind a wall of 12 cells with a slot of 3 at its foot overtops it, drains through the slot and off an open
/// end; then the tank is filled again.
struct Vessel {
  bool slip;  ///< of bed and wall; then the upper end is open too: nothing holds the last drops
  lbm::LiquidRegion reservoir{Vec3::Zero(), Vec3(30, 8 - 1e-9, 24)};

  [[nodiscard]] lbm::FluidOptions options() const {
    const WallSlip sliding = slip ? WallSlip::free_slip : WallSlip::no_slip;
    lbm::FluidOptions o = open_tank({64, 8, 40}, 1e-3, down_slope(2e-4));
    o.domain.faces[1] = lbm::FaceKind::open;
    o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
    if (slip) {
      o.domain.faces[0] = o.domain.faces[4] = lbm::FaceKind::open;
      o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, sliding});
    }
    o.domain.walls.add({"weir", SolidBox{Vec3(30, -8, 3), Vec3(33, 16, 12)}, sliding});
    return o;
  }
};

/// Steps, and the worst ledger of them, of the liquid put in.
template <class Real>
void drain(lbm::Fluid<Real>& fluid, int steps, double& worst) {
  for (int s = 0; s < steps && fluid.wet_cells() > 0; ++s) {
    fluid.step();
    if (s % 10 == 0) keep_worst(worst, std::abs(fluid.mass_drift()));
  }
  keep_worst(worst, std::abs(fluid.mass_drift()));
}

/// What a film that drains off a bed of 64 x 8 cells leaves by then: thickness sqrt(nu x / (g t)), Jeffreys 1930.
double draining_film(const lbm::FluidOptions& o, double steps) {
  return 8 * 2.0 / 3.0 * std::pow(64, 1.5) * std::sqrt(o.kinematic_viscosity / (o.gravity.x() * steps));
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    for (const bool slip : {true, false}) {
      const Vessel vessel{slip};
      const std::string name = slip ? "slipping walls: " : "no-slip walls: ";
      const int steps = slip ? 8000 : context.quick ? 4000 : 30000;
      lbm::Fluid<Real> fluid(vessel.options());
      fluid.fill({vessel.reservoir});
      const double start = fluid.liquid_mass();
      double worst = 0;
      drain(fluid, kFilling, worst);
      const auto first_wet = static_cast<double>(fluid.wet_cells());
      drain(fluid, steps - kFilling, worst);
      if (slip) {
        rows.push_back(at_most_row(name + "wet cells left", static_cast<double>(fluid.wet_cells()), 0));
        rows.push_back(at_most_row(name + "liquid left, of all", std::abs(fluid.liquid_mass()) / start, 1e-9));
        for (int s = 0; s < 100; ++s) fluid.step();  // of nothing
        rows.push_back(at_most_row(name + "blocks left", static_cast<double>(fluid.grid().owned().size()), 0));
      } else if (!context.quick) {
        // By then the film is 0.14 cells thick at most; thinner ones than sqrt(9 nu) = 0.095 are too fast
        // (docs/decisions/0042), and too little is left.
        rows.push_back(relative_row(name + "liquid left, of what Jeffreys' film leaves",
                                    fluid.liquid_mass() / draining_film(fluid.options(), steps), 1, 0.3));
      }
      fluid.fill({vessel.reservoir});
      drain(fluid, kFilling, worst);
      rows.push_back(relative_row(name + "wet cells 500 steps after the second filling; after the first",
                                  static_cast<double>(fluid.wet_cells()), first_wet, 0.05));
      if (!context.quick) drain(fluid, 2500, worst);
      rows.push_back(at_most_row(name + "in - out - left, of in, with the second filling", worst,
                                 sizeof(Real) == 8 ? 1e-10 : 1e-6));
    }
    return rows;
  });
}

}  // namespace

Entry draining_and_rewetting() {
  return {"free_surface.draining_and_rewetting",
          {"case H13 of the hard cases: overtopping, draining, wetting again", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate
