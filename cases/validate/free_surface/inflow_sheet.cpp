// Sheets of a few cells that an inflow brings at 4 m/s over a bed without friction, with the box away from walls and
// against one: nothing pushes them, so their momentum is that of what came. (Liquid put into full cells pushed on cells
// at the surface that took a part of it; a wall behind the box held what was put beside it: docs/decisions/0091.)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/validate/entry.h"
#include "lbm/step/fluid.h"

namespace lahar::validate {
namespace {

constexpr double kCell = 0.02, kSpeed = 4;  // m, m/s

/// Momentum along x after 0.4 s over what was brought. `first`: cells between the box and the wall behind it.
template <class Real>
double momentum_share(double depth, int first, int length, double gravity) {
  lbm::FluidOptions o;
  o.domain.cell_size = kCell;
  o.domain.upper = kCell * Vec3(120, 4, std::ceil(depth) + 9);
  o.domain.slip = WallSlip::free_slip;
  o.density = 1000, o.kinematic_viscosity = 1e-6;
  o.time_step = 0.1 * kCell / kSpeed;
  o.gravity = Vec3(0, 0, -gravity);
  const double discharge = kSpeed * depth * 4 * kCell * kCell;
  o.inflows.push_back({"sheet",
                       kCell * Vec3(first, 0, 0),
                       kCell * Vec3(first + length, 4, std::ceil(depth)),
                       Vec3(kSpeed, 0, 0),
                       {{{0, discharge}, {10, discharge}}}});
  lbm::Fluid<Real> fluid(o);
  while (fluid.time() < 0.4) fluid.step();
  double momentum = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { momentum += o.density * c.liquid_volume * c.velocity.x(); });
  return momentum / (fluid.inflow_mass() * kSpeed);
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    const auto add = [&](const std::string& where, double depth, int first, int length, double gravity) {
      rows.push_back(relative_row(fmt::format("{} cells deep, {}", depth, where),
                                  momentum_share<Real>(depth, first, length, gravity), 1, 0.03));
    };
    for (const double depth : {1.5, 2.2, 3.0, 4.5, 8.0}) {
      if (context.quick && depth != 2.2 && depth != 4.5) continue;
      const int length = std::max(4, static_cast<int>(std::ceil(depth)));
      add("box away from walls", depth, 4, length, 9.81);
      add("box at a wall", depth, 0, length, 9.81);
    }
    if (context.quick) return rows;
    add("box of one cell", 2.2, 4, 1, 9.81);
    add("without gravity", 4.5, 4, 4, 0);
    return rows;
  });
}

}  // namespace

Entry inflow_sheet() { return {"free_surface.inflow_sheet", {"momentum of what comes in"}, run}; }

}  // namespace lahar::validate
