// Gas trapped in a cup under water: the gas has the pressure of the air, so the cup must fill.
#include <algorithm>
#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

/// An inverted cup under water, gas inside: in a gas of constant pressure it must fill.
std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    const Vec3i cells(32, 8, 40);
    const double gravity = 1e-4;
    lbm::FluidOptions o = open_tank(cells, 1e-4, Vec3(0, 0, -gravity));
    o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
    o.domain.walls.add({"lid", SolidBox{Vec3(8, -8, 18), Vec3(24, 16, 20)}});
    o.domain.walls.add({"left", SolidBox{Vec3(8, -8, 8), Vec3(10, 16, 20)}});
    o.domain.walls.add({"right", SolidBox{Vec3(22, -8, 8), Vec3(24, 16, 20)}});
    lbm::Fluid<Real> fluid(o);
    const double w = cells.y() - 1e-9, level = 28;
    fluid.fill({{Vec3(0, 0, 0), Vec3(32, w, 10)},
                {Vec3(0, 0, 10), Vec3(8, w, level)},
                {Vec3(24, 0, 10), Vec3(32, w, level)},
                {Vec3(8, 0, 20), Vec3(24, w, level)}});
    const double impact = std::sqrt(2 * gravity * (level - 10));
    double speed = 0;
    const int steps = context.quick ? 1500 : 10000;
    for (int s = 1; s <= steps; ++s) {
      fluid.step();
      if (s % 10 == 0) speed = std::max(speed, fastest(fluid));
    }
    double inside = 0;
    fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
      if (c.centre.x() > 10 && c.centre.x() < 22 && c.centre.z() > 10 && c.centre.z() < 18) inside += c.liquid_volume;
    });
    std::vector<Row> rows{at_most_row("fastest cell over the fall of the level", speed / impact, 2),
                          at_most_row("mass drift", std::abs(fluid.mass_drift()), sizeof(Real) == 8 ? 1e-10 : 1e-6)};
    if (!context.quick) rows.push_back(at_least_row("part of the cup that has filled", inside / (12 * 8 * 8), 0.99));
    return rows;
  });
}

}  // namespace

Entry trapped_gas() {
  return {"free_surface.trapped_gas", {"case H8 of the hard cases: gas trapped under a lid", {"hard_cases.csv"}}, run};
}

}  // namespace lahar::validate
