// A block of water flies into a closed corner at 10 m/s: its impulse must not depend on the time step.
#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

/// Momentum, of the initial one, that a block lost which flew into a closed corner: by the times when its middle and
/// its end would have reached the wall, and after 3 of its lengths. Half-way the sound of the blow is heard: it runs
/// through the block in 35 steps, a third of the hit at 0.1.
struct Impulse {
  double half_way = 0, hit = 0, settled = 0;
  double limited_cells = 0;     ///< most in a step that the velocity limiter slowed
  double limited_stresses = 0;  ///< cell updates with a limited stress, of all
};

template <class Real>
Impulse impulse(double lattice_velocity) {
  const Vec3i cells(32, 8, 24);
  const double gap = 4, length = 20;
  lbm::FluidOptions o = open_tank(cells, 1e-5, Vec3::Zero());
  o.gravity = Vec3(0, 0, -9.81 * std::pow(lattice_velocity, 2) / 10000);  // 10 m/s in cells of 10 mm
  o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
  o.domain.faces[5] = lbm::FaceKind::closed;
  lbm::Fluid<Real> fluid(o);
  const double start = cells.x() - gap - length;
  fluid.fill({{Vec3(start, 0, 0), Vec3(start + length, cells.y() - 1e-9, 12), Vec3(lattice_velocity, 0, 0)}});
  const auto momentum = [&] {
    double sum = 0;
    fluid.for_each_wet_cell(
        [&](const lbm::WetCell& c) { sum += c.liquid_volume * (1 + 3 * c.pressure) * c.velocity.x(); });
    return sum;
  };
  const double initial = momentum();
  const auto lost_after = [&](double way) {
    while (static_cast<double>(fluid.steps()) < way / lattice_velocity) fluid.step();
    return 1 - momentum() / initial;
  };
  Impulse i;
  i.half_way = lost_after(gap + length / 2);
  i.hit = lost_after(gap + length);
  i.settled = lost_after(3 * length);
  i.limited_cells = static_cast<double>(fluid.limited_cells());
  i.limited_stresses = static_cast<double>(fluid.account().limited) / fluid.cell_updates();
  return i;
}

/// 10 m/s into a closed corner under a closed top.
std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    const Impulse full = impulse<Real>(0.1), half = impulse<Real>(0.05);
    return std::vector<Row>{
        absolute_row("momentum that the corner took of the whole block, of all, lattice velocity 0.1", full.hit, 1,
                     0.12),
        absolute_row("the same at 0.05", half.hit, 1, 0.12),
        absolute_row("the same after 3 lengths, 0.1", full.settled, 1, 0.1),
        absolute_row("the same after 3 lengths, 0.05", half.settled, 1, 0.1),
        relative_row("momentum that the corner took at 0.1 against 0.05", full.hit, half.hit, 0.05),
        relative_row("momentum that the corner took half-way through the hit, 0.1 against 0.05", full.half_way,
                     half.half_way, 0.05),
        relative_row("the same after 3 lengths, 0.1 against 0.05", full.settled, half.settled, 0.05),
        note_row("most cells in a step that the velocity limiter slowed, 0.1", full.limited_cells),
        note_row("most cells in a step that the velocity limiter slowed, 0.05", half.limited_cells),
        at_most_row("cell updates with a limited stress at 0.1, of all", full.limited_stresses, 0.02),
        at_most_row("cell updates with a limited stress at 0.05, of all", half.limited_stresses, 0.02)};
  });
}

}  // namespace

Entry impact_in_corner() {
  return {"free_surface.impact_in_corner",
          {"case H14 of the hard cases: water into a closed corner at 10 m/s", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate
