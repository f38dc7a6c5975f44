// A sheared flow in a box of slipping walls in steps, disturbed by noise: nothing drives it, so its energy cannot rise,
// and nothing brakes it, so it keeps its momentum along the axis of the box.
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"

namespace lahar::validate {
namespace {

constexpr int kNoiseDecays = 100;  // steps

struct Kept {
  double energy = 0;    ///< largest rise once the noise has decayed, of what there is then
  double momentum = 0;  ///< along the box, share of it that changed
};

/// Box of 16 x 8 x 16 cells, turned by atan(1/2) about y, the direction of the flow and of the axis. Lattice units.
Kept run_box(double smagorinsky, int steps) {
  lbm::FluidOptions o = lattice_box({40, 8, 40}, 5e-6);
  o.smagorinsky = smagorinsky;
  for (const std::size_t face : {0U, 1U, 4U, 5U}) o.domain.faces[face] = lbm::FaceKind::closed;
  const Vec3 up = Vec3(-1, 0, 2).normalized(), along(up.z(), 0, -up.x()), middle(20, 0, 20);
  for (const Vec3& side : {Vec3(up), Vec3(-up), Vec3(along), Vec3(-along)})
    o.domain.walls.add({"side", HalfSpace{Vec3(middle + 8 * side), Vec3(-side)}, WallSlip::free_slip});
  lbm::Fluid<double> fluid(o);
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 0.01);
  fluid.fill_everything(
      [&](const Vec3& p) {
        const double speed = 0.05 * (1 + 0.3 * std::sin(0.4 * (p - middle).dot(up)));
        return Vec3(normal(random), speed + normal(random), normal(random));
      },
      no_pressure);
  const auto momentum = [&] {
    double sum = 0;
    fluid.for_each_wet_cell([&](const lbm::WetCell& c) { sum += (1 + 3 * c.pressure) * c.velocity.y(); });
    return sum;
  };
  const double start = momentum();
  double calm = 0;
  EnergyRise energy;
  for (int s = 1; s <= steps; ++s) {
    fluid.step();
    if (s == kNoiseDecays) calm = flow_energy(fluid);
    if (s >= kNoiseDecays && s % 20 == 0) energy.note(flow_energy(fluid));
  }
  Kept kept;
  kept.energy = energy.largest() / calm;
  kept.momentum = momentum() / start - 1;
  return kept;
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  for (const double smagorinsky : {0.0, 0.1}) {
    const Kept kept = run_box(smagorinsky, context.quick ? 800 : 4000);
    rows.push_back(at_most_row(fmt::format("Cs {:g}: rise of energy after the noise", smagorinsky), kept.energy, 5e-3));
    rows.push_back(
        absolute_row(fmt::format("Cs {:g}: momentum won or lost along the box", smagorinsky), kept.momentum, 0, 0.01));
  }
  return rows;
}

}  // namespace

Entry slipping_box() {
  return {"fluid.slipping_box", {"energy and momentum of an unforced flow between slipping walls"}, run};
}

}  // namespace lahar::validate
